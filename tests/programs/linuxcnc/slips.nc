; Slips that the interpreter stops at
G21 G17 G90 G40 G49 G80 G54
T1 M6
G43
S1200 M3
G0 X0 Y0 Z5
G81 X10 Z-5 R2
(    ^^^ expect: feed-missing definite)
X20 Z-6
G80
F200
G83 X30 Z-5 R2
(^^^ expect: cycle-peck-invalid definite)
G80
G1 X40 R7
(       ^^ expect: block-unused-word definite)
G2 X50 Y1 I5
(^^^^^^^^^^^^ expect: arc-radius-mismatch definite)
o101 if [#31 GT 1]
(^^^^^^^^^^^^^^^^^^ expect: flow-structure-mismatch definite)
  G0 X5
o102 endif
(^^^^^^^^^^ expect: flow-structure-mismatch definite)
#5420 = 1
( ^^^^ expect: variable-read-only-write definite)
G0 X#<nowhere>
(     ^^^^^^^^^ expect: variable-read-before-write definite)
M20
(^^^ expect: block-unknown-m-code definite)
G90 G91
(    ^^^ expect: block-modal-group-conflict definite)
G90
#31 = [ATAN[1] * 2]
(      ^^^^^^^^^^^^^ expect: syntax-error definite)
o<missing> call [3]
(  ^^^^^^^ expect: flow-undefined-subprogram definite)
M5
M2
