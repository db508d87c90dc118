" NC program: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetParameter /\v[DEFIJKLOPQRST][-+0-9.#\[]@=/
syn match ncvetAxis /\v[ABCHUVWXYZ][-+0-9.#\[]@=/
syn match ncvetVariable /\v\#+%([0-9]+|\<[^<>]*\>|_?[A-Z][A-Z0-9_]*)?/
syn match ncvetUnknown /\vM[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\vM0*%(0|1%(0[459]?|1[0123456789]?|2[0123456789]?|3[0134589]?|4[34567]?|5[4589]?|6[0123]?|7[01]?|8[012345]?|9[89]?)?|2%(19?|2|3|4|5|6|7|8|9)?|3%(0[012]?|1|2|3|4|5|6|7|8|9)?|4[012345689]?|5[0123456789]?|6[0123456789]?|7[0123456789]?|8[012345689]?|9[0156789]?)[0-9.]@!/
syn match ncvetUnknown /\vG[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\vG0*%(0|1%(0%(\.6|0|1|2|3|5|7)?|1[0123456789]?|2%(\.[14]|0|1|2|3|4|5|6|7|8|9)?|3%(\.[14]|6)?|4[13]?|5[01234569]?|6[012345679]?|74?|8[467]?|9[5689]?)?|2%(\.[24]|00?|1[12]?|2|34?|4[123569]?|5[01345]?|6[689]?|7|8%(\.2)?|9)?|3%(\.[24]|0%(\.1)?|1|2|3|4|5|6|7%(\.[12])?|8|9)?|4%(0%(\.1)?|1%(\.[123456])?|2%(\.[12456])?|3%(\.[1345789])?|4|5|6|7|8|9)?|5%(\.[14]|0%(\.[123])?|1%(\.[12])?|2|3%(\.[16])?|4%(\.[124])?|5|6|7|8|9)?|6%(\.2|0|1|2|3|4|5|6%(\.1)?|7|8%(\.[1234])?|9%(\.1)?)?|7%(\.1|0|1|2%(\.[12])?|3|4|5|6|7|8|9)?|8%(0%(\.[45])?|1%(\.[145])?|2|3%(\.[13])?|4%(\.[23])?|5|6|7|8|9)?|9%(0|1%(\.1)?|2%(\.1)?|3|4|5|6|7|8|9)?)[0-9.]@!/
syn match ncvetFunction /\v[A-Za-z]@<!%(A%(BS|COS|DP|SIN|TAN|X%(NUM)?)|B%(CD|IN)|COS|EXP|F%(IX|UP)|LN|P%(OW|RM)|R%(ND|OUND)|S%(IN|QRT?)|TAN)[A-Za-z]@!/
syn match ncvetOperator /\v[A-Za-z]@<!%(AND|EQ|G[ET]|L[ET]|MOD|NE|OR|XOR)[A-Za-z]@!/
syn match ncvetKeyword /\v[A-Za-z]@<!%(BPRNT|D%(O|PRNT)|END|GOTO|IF|P%(CLOS|OPEN)|SETVN|THEN|WHILE)[A-Za-z]@!/
syn match ncvetNumberOfBlock /\v[A-Za-z0-9_$]@<!N[0-9]+%(\.[0-9]+)?/
syn match ncvetTape /\v\%[0-9A-Za-z_]@!/
syn match ncvetProgram /\v[A-Za-z#]@<!%(O[0-9]+|:[0-9]+|\%O?[0-9]+|\<[A-Z][A-Z0-9_+-]*\>)/
syn match ncvetComment /\v\([^\)]*%(\)|$)/
syn match ncvetComment /\v;.*$/
hi def link ncvetAxis Keyword
hi def link ncvetCode Function
hi def link ncvetComment Comment
hi def link ncvetFunction Special
hi def link ncvetKeyword Conditional
hi def link ncvetMiscellaneous Macro
hi def link ncvetNumber Number
hi def link ncvetNumberOfBlock Label
hi def link ncvetOperator Operator
hi def link ncvetParameter PreProc
hi def link ncvetProgram Title
hi def link ncvetTape PreProc
hi def link ncvetVariable Identifier
let b:current_syntax = 'gcode'
