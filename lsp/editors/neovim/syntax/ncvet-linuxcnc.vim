" LinuxCNC 2.9, RS274/NGC: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetParameter /\v[DEFHIJKLOPQRST][-+0-9.#\[]@=/
syn match ncvetParameter /\v\$[-+0-9.#\[]@=/
syn match ncvetAxis /\v[ABCUVWXYZ][-+0-9.#\[]@=/
syn match ncvetAxis /\v%(\@|\^)[-+0-9.#\[]@=/
syn match ncvetVariable /\v\#+%([0-9]+|\<[^<>]*\>)?/
syn match ncvetUnknown /\vM[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\vM0*%(0|1%(0[0123456789]|1[0123456789]|2[0123456789]|3[0123456789]|4[0123456789]|5[0123456789]|6[0123456789]|7[0123456789]|8[0123456789]|9[0123456789]?)?|2|30?|4[89]?|5[0123]?|6[012345678]?|7[0123]?|8|9[89]?)[0-9.]@!/
syn match ncvetUnknown /\vG[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\vG0*%(0|1%(0|7%(\.1)?|8%(\.1)?|9%(\.1)?)?|2%(0|1|8%(\.1)?)?|3%(0%(\.1)?|3%(\.1)?|8\.[2345])?|4%(0|1%(\.1)?|2%(\.1)?|3%(\.[12])?|9)?|5%(\.[123]|2|3|4|5|6|7|8|9%(\.[123])?)?|6%(\.2|1%(\.1)?|4)|7%(0|1%(\.[12])?|2%(\.[12])?|3|4|6)?|8[0123456789]?|9%(0%(\.1)?|1%(\.1)?|2%(\.[123])?|3|4|5|6|7|8|9))[0-9.]@!/
syn match ncvetFunction /\v[A-Za-z]@<!%(A%(BS|COS|SIN|TAN)|COS|EX%(ISTS|P)|F%(IX|UP)|LN|ROUND|S%(IN|QRT)|TAN)[A-Za-z]@!/
syn match ncvetOperator /\v[A-Za-z]@<!%(AND|EQ|G[ET]|L[ET]|MOD|NE|OR|XOR)[A-Za-z]@!/
syn match ncvetKeyword /\v[A-Za-z]@<!%(BREAK|C%(ALL|ONTINUE)|DO|E%(LSE%(IF)?|ND%(IF|REPEAT|SUB|WHILE))|IF|RE%(PEAT|TURN)|SUB|WHILE)[A-Za-z]@!/
syn match ncvetLabel /\v[A-Za-z0-9_$]@<!O[0-9]+[=]@!/
syn match ncvetNumberOfBlock /\v[A-Za-z0-9_$]@<!N[0-9]+%(\.[0-9]+)?/
syn match ncvetTape /\v\%[0-9A-Za-z_]@!/
syn match ncvetProgram /\v[A-Za-z#]@<!O\<[^<>]*\>/
syn match ncvetComment /\v\([^\)]*%(\)|$)/
syn match ncvetComment /\v;.*$/
hi def link ncvetAxis Keyword
hi def link ncvetCode Function
hi def link ncvetComment Comment
hi def link ncvetFunction Special
hi def link ncvetKeyword Conditional
hi def link ncvetLabel Label
hi def link ncvetMiscellaneous Macro
hi def link ncvetNumber Number
hi def link ncvetNumberOfBlock Label
hi def link ncvetOperator Operator
hi def link ncvetParameter PreProc
hi def link ncvetProgram Title
hi def link ncvetTape PreProc
hi def link ncvetVariable Identifier
let b:current_syntax = 'ncvet-linuxcnc'
