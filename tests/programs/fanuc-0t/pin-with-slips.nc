%
O0211 (PIN 20)
G21 G40 G95
G50 S3000
G28 U0 W0
N1 T0101
G97 S1200 M3 M4
(             ^^ expect: block-modal-group-conflict definite)
G0 X22. Z2. M8
G1 Z-30. F0,15
(         ^^^^^ expect: syntax-decimal-comma definite)
G1 X24. U2.
(        ^^^ expect: block-mixed-absolute-incremental definite)
G0 Z2.
G33 Z-20. F1.5
(^^^ expect: block-code-not-on-control definite)
G4
(^^ expect: block-missing-word definite)
G28 U0 W0 M9
M5
M30
%
