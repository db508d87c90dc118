" FANUC 0i, 16i/18i/21i, 30i to 35i: lathe: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetParameter /\v[ADEFIJKLOPQRST][-+0-9.#\[]@=/
syn match ncvetAxis /\v[BCHUVWXYZ][-+0-9.#\[]@=/
syn match ncvetVariable /\v\#+%([0-9]+|\<[^<>]*\>|_?[A-Z][A-Z0-9_]*)?/
syn match ncvetUnknown /\vM[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\vM0*%(0|1%(0|1|2|3|4|5|6|7|8|98?)?|2[89]?|30?|4[01234589]?|5[01]?|6[089]?|7[89]?|8|9[6789]?)[0-9.]@!/
syn match ncvetUnknown /\vG[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\vG0*%(0|1%(0[07]?|1[23]?|2\.1|3\.1|7|8|9)?|2%(0|1|2|3|4|5[01]?|6|7|8%(\.2)?|9)?|3%(0%(\.1)?|1|2|3|4|5|6|7%(\.[12])?)?|4%(0|1|2|3%(\.[457])?|4|9)?|5%(\.[14]|0%(\.[123])?|1%(\.[12])?|2|3%(\.1)?|4%(\.1)?|5|6|7|8|9)?|6%(1|2|3|4|5|6|7|8%(\.[12])?|9%(\.1)?)|7%(\.1|0|1|2|3|4|5|6|7|8|9)|8%(0|1|2|3|4%(\.[23])?|5|6|7|8|9)?|9%(0|1%(\.1)?|2%(\.1)?|3|4|5|6|7|8|9)?)[0-9.]@!/
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
let b:current_syntax = 'ncvet-fanuc-lathe'
