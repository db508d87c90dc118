%
O0311 (POCKET 40X30)
G21 G17 G40 G49 G80 G90 G94
N10 T1 M6 (END MILL 10)
G54 G0 X30. Y20. S2500 M3
G43 Z50. H1 M8
Z2.
G1 Z-4. F150
G1 X50. Y20. X52. F400
(             ^^^^ expect: block-duplicate-address definite)
G90 G0 G1 Y40.
(       ^^ expect: block-modal-group-conflict definite)
X10. Y−20.
(      ^ expect: syntax-invalid-character definite)
G0 Z50. M9
N10 G4
(^^^ expect: program-block-number-duplicate definite)
(    ^^ expect: block-missing-word definite)
G49
G28 G91 Z0 M5
M30
G0 X0 Y0
(^^^^^^^^ expect: program-code-after-end definite)
%
