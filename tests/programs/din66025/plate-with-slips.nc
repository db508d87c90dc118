%100
N10 G17 G90 G40 G80 G94 G54
N20 T1 M6
N30 G4 P1
N40 G0 X0 Y0 Z50
N50 S1200 M3
N60 Z2
N70 G1 Z-3 F150
N80 X60 X62 F400
(        ^^^ expect: block-duplicate-address definite)
N90 G0 G1 Y40
(       ^^ expect: block-modal-group-conflict definite)
N100 X0
N110 Y0
N120 G0 Z50
N130 G81 X20 Y20 Z-10 R2 F120
N140 X40
N150 G80
N160 G2 X50 Y1 I5 J0
(     ^^^^^^^^^^^^^^^ expect: arc-radius-mismatch definite)
N170 G0 Z100 M5
N180 M30
N190 X0
(^^^^^^^ expect: program-code-after-end definite)
