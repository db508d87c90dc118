( a tool is measured, and nothing turns )
o<measure> sub
  T1 M6
  M5
  F100
  G49
  G91
  G38.3 Z-10
  G1 Z2
  G90
  G43
  F0
o<measure> endsub
o<inches> sub
  M73
  G20 G91
  F5
o<inches> endsub
G21 G17 G90 G94 G40 G54
o<measure> call
o<inches> call
F200
G0 Z20
G49
M2
