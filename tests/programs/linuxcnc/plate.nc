; Plate 120 x 80 x 12, aluminium; zero at the lower left corner, top
(T1 end mill 10, T2 drill 6.8)
#<_safe> = 20
#<_top> = 2
o<pocket> sub
  (#1 #2 centre, #3 half side, #4 depth of a cut)
  G0 X#1 Y#2
  G0 Z#<_top>
  #<z> = 0
  o101 while [#<z> GT -6]
    #<z> = [#<z> - #4]
    o102 if [#<z> LT -6]
      #<z> = -6
    o102 endif
    G1 Z#<z> F120
    G1 X[#1 + #3] F400
    Y[#2 + #3]
    X[#1 - #3]
    Y[#2 - #3]
    X[#1 + #3]
    Y#2
    X#1
  o101 endwhile
  G0 Z#<_safe>
o<pocket> endsub [#<z>]

G17 G21 G40 G49 G54 G80 G90 G94 G64 P0.02
T1 M6
G43
S6000 M3
M8
G0 X40 Y40 Z#<_safe>
o<pocket> call [40] [40] [10] [2.5]
o110 if [#<_value> NE -6]
  (ABORT, the pocket is not deep enough)
o110 endif
o<pocket> call [80] [40] [8] [2]
(a side that is open: compensated)
G0 X-12 Y-12
G41 D1 G1 X0 F400
G1 Z-3 F300
Y80 F400
G40 G1 X-12 Y92
G0 Z#<_safe>
M9
M5

T2 M6
G43
S2000 M3
M8
#1 = 0
o120 repeat [3]
  #1 = [#1 + 1]
  G98 G81 X[#1 * 30] Y12 Z-14 R#<_top> F180
  Y68
o120 endrepeat
G80
o<park> call [#<_safe>]
M9
M5
M2
