%O420 (COVER)
(^^^^^ expect: program-name-invalid definite)
N10 G54 G17 G90 G40 G94
N20 T4
N30 G43 G0 Z60 H4 D4
N40 S1200 M3
N50 M8
G0 X-15 Y-15
Z2
G1 Z-3 F100
Y20 X
(    ^ expect: syntax-incomplete-word definite)
N55 Y30 $5
(        ^^ expect: syntax-unknown-address definite)
N55 X10
(^^^ expect: program-block-number-duplicate definite)
N40 Y-15 (M01)
(^^^ expect: program-block-number-order definite)
(         ^^^^^ expect: syntax-code-in-comment definite)
G4
(^^ expect: block-missing-word definite)
G0 Z60
G0 G49 Z120
M9
M5
M8 M9
(   ^^ expect: block-modal-group-conflict definite)
M30
(^^^ expect: program-frame-missing definite)
