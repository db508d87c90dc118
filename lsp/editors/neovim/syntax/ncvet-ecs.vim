" ECS CNC: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetVariable /\v[A-Za-z0-9_$]@<![A-Z_][A-Z0-9_]+/
syn match ncvetParameter /\v[A-Za-z_$]@<![DFIJKLOPRST][-+0-9.=R(]@=/
syn match ncvetParameter /\v[A-Za-z0-9_$]@<![DFIJKLOPRST][0-9][=]@=/
syn match ncvetParameter /\v[A-Za-z0-9_$]@<!%(RA|RB|RC|SM)[-+=0-9.(]@=/
syn match ncvetAxis /\v[A-Za-z_$]@<![ABCUVWXYZ][-+0-9.=R(]@=/
syn match ncvetAxis /\v[A-Za-z0-9_$]@<![ABCUVWXYZ][0-9][=]@=/
syn match ncvetAxis /\v[A-Za-z0-9_$]@<!%(DA|DB|DC|DU|DV|DW|DX|DY|DZ)[-+=0-9.(]@=/
syn match ncvetVariable /\v[A-Za-z_$]@<!%(A%(AT|IN|LT|N[23ALR]|PA|RC|SF|TL|XS)|CFF|D%(A[XY]|IA|LN|PA|QS|RA|T[XYZ]|ZS)|ENT|F%(E[123]|OR)|IN[DITXY]|K%(F[DE]|PE|RU)|L%(TZ|UN)|M%(CT|IS|X[LPRU])|P%(CH|G[AB]|OS|PA|RT|X[LR]|Y[LR])|Q%(F[IO]|IN|PO)|R%(A[DGLP]|DF|FI|GS|I[CN]|OT|TA|UT)|S%(CA|F[12]|IZ|ME|PD|T[RZ])|T%(IM|PC|RN|TC|YP)|WTL|X%(AT|CE)|Y%(AT|CE))[A-Za-z0-9_]@!/
syn match ncvetVariable /\v[A-Za-z_$]@<![RV][0-9]+[A-Za-z_]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!M[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\v[A-Za-z_$]@<!M0*%(0|1[013479]?|2[89]?|30?|4[012345]?|5|6|8|9[89]?)[0-9.]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!G[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\v[A-Za-z_$]@<!G0*%(0|1%(00?|1|2|3|50|6|7[59]?|8[456789]?|90?)?|2%(0[012345678]|1[01]|3|4|50?|6)?|3%(0[89]?|6)?|4[01234678]?|5%(1|3|4%(\.%(0[123456789]|1[0123456789]?|2[0123456789]?|3[0123456789]?|4[0123456789]?|50?|6|7|8|9))?|5|6|7|8|9)|6[0246789]|7%(01?|1|2[2678]|3[678]|7[789]|9[12345789])|8[0123456789]|9[01245])[0-9.]@!/
syn match ncvetCode /\v[A-Za-z_$]@<!%(D%(0|CT|LN|MX|RA)|ELEMENT|G16%(A%(X[YZ]|Y[XZ]|Z[XY])|B%(X[YZ]|Y[XZ]|Z[XY])|C%(X[YZ]|Y[XZ]|Z[XY])|X%(A[YZ]|B[YZ]|C[YZ]|YZ|ZY)|Y%(A[XZ]|B[XZ]|C[XZ]|XZ|ZX)|Z%(A[XY]|B[XY]|C[XY]|XY|YX))|M%(AT|IR|TX)|RET|S%(EZ|KP|PL|T[PR])|T%(CT|GR|IM))[A-Za-z0-9_]@!/
syn match ncvetFunction /\v[A-Za-z_$]@<!%(A%(BS|CS|SN|TN)|COS|FT[IL]|RND|S%(IN|QR)|TAN)[A-Za-z0-9_]@!/
syn match ncvetKeyword /\v[A-Za-z_$]@<!%(I%(F[CF]|NP)|JM[CP]|RPT)[A-Za-z0-9_]@!/
syn match ncvetLabel /\v[A-Za-z0-9_$]@<!\[[A-Z0-9_]+\][=]@!/
syn match ncvetNumberOfBlock /\v[A-Za-z0-9_$]@<!N[0-9]+[A-Za-z_]@!/
syn match ncvetProgram /\v[A-Za-z_$#>]@<!L\<[^<>]*\>/
syn match ncvetString /"[^"]*\("\|$\)/
syn match ncvetComment /\v\'.*$/
syn match ncvetComment /\v\{[^\}]*%(\}|$)/
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
hi def link ncvetString String
hi def link ncvetVariable Identifier
let b:current_syntax = 'ncvet-ecs'
