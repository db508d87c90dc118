%
O00420 (COVER 80X60)
(T1 END MILL 12, T2 DRILL 8.5)
G21 G17 G40 G49 G80 G90 G94
T1 M06
G54 G00 X-20. Y-20. S3200 M03
G43 H01 Z50. M08
G00 Z2.
G01 Z-6. F200.
G41 D01 X0. Y-20. X-1. F650.
(                  ^^^^ expect: block-duplicate-address definite)
G01 Y60.
X80.
Y0.
X-20.
G00 Z50. M09
G49
G91 G28 Z0.
(    ^^^ expect: compensation-forbidden-code definite)
G90
T2 M06
(   ^^^ expect: compensation-left-on definite)
G54 G00 G40 X15. Y15. S1900 M03
G43 H02 Z50. M08
G99 G81 Z-20. R2. F180.
X65.
Y45.
X15.
G80
G00 Z50. M09
G54 G55 X10. Y0.
(    ^^^ expect: block-modal-group-conflict definite)
M05
G49
G91 G28 Z0.
M30
%
