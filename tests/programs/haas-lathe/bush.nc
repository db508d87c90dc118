O1202 (BUSH 40X30)
G21 G99
G00 G53 X-200. Z-250.
G54 G50 S3000
N100 T101 (FACING AND TURNING)
G96 S180 M03 M08
(             ^^^ expect: block-too-many-m-codes definite)
G00 X44. Z0.
G01 X-1.6 F0.15
G00 X40 Z2.
(    ^^^ expect: syntax-missing-decimal-point definite)
G01 Z-32. X40.5 Z-33.
(                ^^^^^ expect: block-duplicate-address definite)
G00 X44.
G53 X-200. Z-250.
M09
N200 T202 (DRILL 12)
G97 S900 M03
G00 X0 Z5.
M08
G83 Z-35. R2. Q8. F0.12
G80
G53 G00 X-200. Z-250.
M09
N300 T303 (BORING BAR)
G97 S1200 M03
G00 X14. Z2.
M08
G01 Z-31. F0.1
G00 U-1.
Z2.
G04
(^^^ expect: block-missing-word definite)
G53 X-200. Z-250.
M09
M05
M30
G00 X50.
(^^^^^^^^ expect: program-code-after-end definite)
