" MEFI CNC872 iTD, iTQ: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetVariable /\v[A-Za-z0-9_$]@<![A-Z_][A-Z0-9_]+/
syn match ncvetParameter /\v[A-Za-z_$]@<![FIJKRST][-+0-9.=R]@=/
syn match ncvetParameter /\v[A-Za-z0-9_$]@<![FIJKRST][0-9][=]@=/
syn match ncvetAxis /\v[A-Za-z_$]@<![WXYZ][-+0-9.=R]@=/
syn match ncvetAxis /\v[A-Za-z0-9_$]@<![WXYZ][0-9][=]@=/
syn match ncvetVariable /\v[A-Za-z_$]@<!R[0-9]+[A-Za-z_]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!M[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\v[A-Za-z_$]@<!M0*%(0|30?|4|5|6|8|9)[0-9.]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!G[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\v[A-Za-z_$]@<!G0*%(0|1[789]?|2|3|4[012]|5[3456789]|7[346]|8[0123456789]|9[0145])[0-9.]@!/
syn match ncvetCode /\v[A-Za-z_$]@<!%(C%(ALLCYCLE|CW%(_G1[789])?|W%(_G1[789])?)|ENDPROGRAM|PROGRAM|TRANSLATE)[A-Za-z0-9_]@!/
syn match ncvetNumberOfBlock /\v[A-Za-z0-9_$]@<!N[0-9]*/
syn match ncvetTape /\v\%[0-9A-Za-z_]@!/
syn match ncvetComment /\v\".*$/
hi def link ncvetAxis Keyword
hi def link ncvetCode Function
hi def link ncvetComment Comment
hi def link ncvetMiscellaneous Macro
hi def link ncvetNumber Number
hi def link ncvetNumberOfBlock Label
hi def link ncvetOperator Operator
hi def link ncvetParameter PreProc
hi def link ncvetTape PreProc
hi def link ncvetVariable Identifier
let b:current_syntax = 'ncvet-mefi'
