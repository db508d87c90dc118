%
O3095 (PLATE, AND WHAT A TIRED HAND WRITES)
G21 G17 G40 G49 G80 G90
T1 M06
G54
S1000 M03
G00 X10. Y10.
G43 H1 Z50.
Z2.
G01 Z-2. F100.
G00 Z50.
M05
T2 M06
S1000 M03
G00 X10. Y10.
G43 H1 Z10.
(    ^^ expect: tool-offset-mismatch definite)
G99 G84 X10. Y10. Z-15. R5. F10.
(                            ^^^^ expect: cycle-tap-feed-mismatch definite)
G80
G00 Z50.
M05
G49
M30
%
