" SINUMERIK 840D, milling: its words before the server answers. Made of the tables of the controls by ./dev editors.
if exists('b:current_syntax') | finish | endif
syn case ignore
syn match ncvetOperator /\v[-+*\/=<>&%]/
syn match ncvetNumber /\v%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetNumber /\v[0-9)>\]]@<![-+]%([0-9]+\.?[0-9]*|\.[0-9]+)/
syn match ncvetVariable /\v[A-Za-z0-9_$]@<![A-Z_][A-Z0-9_]+/
syn match ncvetParameter /\v[A-Za-z_$]@<![DEFHIJKPST][-+0-9.=(]@=/
syn match ncvetParameter /\v[A-Za-z0-9_$]@<![DEFHIJKPST][0-9][=]@=/
syn match ncvetParameter /\v[A-Za-z0-9_$]@<!%(ADISPOS|DISCL|SPOSA|ADIS|DISC|DISR|FRCM|LIMS|OFFN|RNDM|SPOS|TURN|ANG|CHF|CHR|FAD|FRC|RND|RPL|AR|CR|FB|FP|FZ|I1|J1|K1|SF)[-+=0-9.(]@=/
syn match ncvetAxis /\v[A-Za-z_$]@<![ABCUVWXYZ][-+0-9.=(]@=/
syn match ncvetAxis /\v[A-Za-z0-9_$]@<![ABCUVWXYZ][0-9][=]@=/
syn match ncvetAxis /\v[A-Za-z0-9_$]@<!%(AP|RP)[-+=0-9.(]@=/
syn match ncvetVariable /\v[A-Za-z_$]@<!R[0-9]+[A-Za-z_]@!/
syn match ncvetVariable /\v\$[A-Z][A-Z0-9_]*[A-Za-z_]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!M[0-9]+%(\.[0-9]+)?/
syn match ncvetMiscellaneous /\v[A-Za-z_$]@<!M0*%(0|1[79]?|2|30?|4[012345]?|5|6|70?|8|9[89]?)[0-9.]@!/
syn match ncvetUnknown /\v[A-Za-z_$]@<!G[0-9]+%(\.[0-9]+)?/
syn match ncvetCode /\v[A-Za-z_$]@<!G0*%(0|1%(0|1[012]|4[012378]|53?|6|7|8|9)?|2%(0|1|2|3|4[78]|5|6|7|8|9[01]?)?|3%(0|1|3[1256]?|4[0178]?|5)?|4%(0|1|2|3|4|5[01]|6[012]|9)?|5%(0[056789]?|1[0123456789]?|2[0123456789]?|3[0123456789]?|4[0123456789]?|5[0123456789]?|6[0123456789]?|7[0123456789]?|8[0123456789]?|9[0123456789]?)?|6%(0[123]?|1|21?|3|4[12345]?|5|6|7|8|9)|7%(00?|10?|2|3|4|5|6)?|8%(0|1[0123456789]?|2[0123456789]?|3|4|5|6|7|8|9)|9%(0|1|2|31?|42?|52?|6[12]?|7[123]?|8|9)?)[0-9.]@!/
syn match ncvetCode /\v[A-Za-z_$]@<!%(A%(3|C%(C%(LIMA)?|TBLOCNO)|D%(DFRAME|ISPOSA)|LF|MIRROR|ROTS?|S%(CALE|PLINE)|T%(OL|RANS)|UXFU%(DEL|MSEQ|SYNC)|X%(CTSWE[CD]?|TOCHAN))|B%(3|AUTO|LSYNC|NAT|RISKA?|SPLINE|TAN)|C%(3|A%(L%(C%(DAT|POSI)|LPATH)|NCEL%(SUB)?)|DO%(F2?|N)|F%(C|IN|TCP)|H%(ANDATA|KDNO)|IP|L%(EARM|OSE|RINT)|O%(ARSEA|LLPAIR|MP%(C%(AD|URV)|O[FN]|SURF)|NT%(DCON|PRON)|RROF|UP%(DE[FL]|O%(FS?|NC?)|RES))|P%(DE[FL]|LO[FN]|O[FN]|R%(ECO[FN]|OT%(DEF)?))?|SPLINE|T%(AB%(DE[FL]|END|LOCK|UNLOCK)?|OL%(G0)?|RANS)?|UT%(2D%(D|FD?)?|3D%(C%(CD?|D)?|F[DFS]?)|CONO[FN]|MODK?)|YCLE%(116|206|6[01234]|7[0123456789]|8%(0[012]|1|2|32?|40?|5|6|7|8|99?)|9%(0|2|30?|40?|5[12]?|61?|7[16789]?|82?|98?)))|D%(EL%(AYFSTO[FN]|D%(L|TG)|ETE|TC?)|I%(AM%(90|C%(HANA|YCOF)|O[FN])|LF|S%(ABLE|P%(LO[FN]|R)|RP)|T[ES])|L|R%(FOF|IVEA?)|YN%(FINISH|NORM|P%(OS|REC)|ROUGH|SEMIFIN)|ZERO)|E%(AUTO|G%(DE[FL]|O%(F[CS]|N%(SYNE?)?))|N%(A%(BLE|T)|DPROC)|Q|SR[RS]|TAN|X%(EC%(STRING|TAB|UTE)|T%(CLOSE2?|OPEN)))|F%(A|C%(TDEF|UB)|DA?|ENDNORM|FWO[FN]|GR%(EF|OUP)|I%(FOCTRL|LE%(DATE|INFO|S%(IZE|TAT)|TIME)|NEA)|L%(I[MN])?|NORM|OC|P%(O|R%(AO[FN])?)|TOC%(O[FN])?|XS[TW]?)|G%(0FWD|4[FS]|E%(OAX|T%(ACTTD?|D%(NO)?|EXET|FREELOC|SELT|T%(COR|ENV))?)?|ROUP_%(ADDEND|BEGIN|END)|T|WPSO[FN])|HOLES[12]|I%(CYCO[FN]|DS?|N%(IT|TERSEC|VC%(CW|W))|P%(OBRKA|TR%(LOCK|UNLOCK))?|R|S%(D|FILE))|J%(ERK%(A|LIMA?)|R)|K%(ONT[CT]?|R)|L%(E%(AD%(O[FN])?|NTOAX)?|F%(O[FN]|POS|TXT2?|WP)|IFTFAST|O%(CK|NGHOLE)|T)|M%(ASL%(DE[FL]|O%(FS?|N))|EA%(C|SA?|WA?)|IRROR|MC|OVT?|PF|SGS?|TL|VTOOL)|N%(CKCOMP|E%(W%(CONF|T)|XT)?|ORM|PROT%(DEF)?)|O%(EMIPO[12]|MA[12345]|PEN|RI%(AX%(ES|POS)|C%(ON%(C%(CW|W)|IO|TO)|URVE)?|D|EULER|MKS|P%(ATHS?|LANE)|R%(ESET|OT[ACRT]|PY2?)|S%(O%(F|LH|N))?|V%(ECT|IRT[12])|WKS)|S%(B|C%(ILL|TRL)?|D|E|NSC|OF|P[12]|SE?|T[12]?)?|TOL%(G0)?|VR%(A|RAP)?)|P%(AROT%(OF)?|DELAYO[FN]|FRAME|HI|L|O%(CKET[1234]|L%(F%(M%(ASK|LIN))?|Y%(PATH)?)|NS?|S%(A|MT|P)?)?|R%(E%(PRO|SETONS?)|IO|OT[AS])|SI|TP%(G0|WOC)?|U%(NCHACC|TFTOCF?)|W)|R%(DISABLE|E%(AD|FIX|LEASE|POS%(A|HA?|L|QA?)|SET%(MON)?|T)|INDEX|M%(B%(BL)?|E%(BL)?|I%(BL)?|N%(BL)?)|OTS?|TLIO[FN])|S%(AVE|BLO[FN]|C%(ALE|PARA)|D|ET%(AL|DNO|FRAME|INT|M%(S|TH)?|P%(IECE|ROTAREA)|T%(A|COR|IA))|IREL%(IN|OUT|TIME)|LOT[12]|O%(FTA?|NS?)|P%(ATH|CO[FN]|IF[12]|LINEPATH|N|OF|P)|RA?|T%(A%(RT%(FIFO)?|T)?|OP%(FIFO|RE%(OF)?)|RINGIS)|UP[AD]|VC|YN%(FCT|R))|T%(ANG%(DEL|O[FN])?|C%(A%(RR)?|I|O%(ABS|FR[XYZ]?))|HE%(N|TA)|I%(A|LT)|LIFT|M%(L|O[FN])|O%(F%(F%(L|O[FN]|R)?|RAME[XYZ]?)|OLMAN|ROT%(OF|S|X|Y|Z)?|W%(BCS|KCS|MCS|STD|TCS|WCS))|RA%(ANG|C%(ON|YL)|FOO[FN]|ILO[FN]|NS%(MIT)?|ORI)|U)|U%(NLOCK|PATH)|VELOLIMA?|W%(A%(IT%(C|E%(NC)?|MC?|P|S)|L%(CS%(0|10?|2|3|4|5|6|7|8|9)|IMO[FN]))|ORKPIECE|RITE))[A-Za-z0-9_]@!/
syn match ncvetSymbol /\v[A-Za-z_$]@<!%(FALSE|TRUE)[A-Za-z0-9_]@!/
syn match ncvetType /\v[A-Za-z_$]@<!%(AXIS|BOOL|CHAR|FRAME|INT|REAL|STRING)[A-Za-z0-9_]@!/
syn match ncvetFunction /\v[A-Za-z_$]@<!%(A%(BS|C%(N|OS|P)?|SIN|TAN2)|BOUND|C%(OS|ROTS?)|DC|EXP|IC|LN|M%(AXVAL|INVAL)|PO%(SM|T)|ROUND%(UP)?|S%(IN|PI|QRT)|T%(AN|RUNC))[A-Za-z0-9_]@!/
syn match ncvetOperator /\v[A-Za-z_$]@<!%(AND|B_%(AND|NOT|OR|XOR)|DIV|MOD|NOT|OR|XOR)[A-Za-z0-9_]@!/
syn match ncvetKeyword /\v[A-Za-z_$]@<!%(AS|CA%(LL|SE)|D%(EF%(AULT|INE)?|O)|E%(LSE|ND%(FOR|IF|LOOP|WHILE)|VERY|XT%(CALL|ERN))|F%(OR|ROM)|GOTO[BCFS]?|I%(F|SOCALL)|LOOP|MCALL|OF|P%(CALL|ROC)|RE%(DEF|PEATB?)|TO|UNTIL|VAR|WH%(EN%(EVER)?|ILE))[A-Za-z0-9_]@!/
syn match ncvetLabel /\v[A-Za-z0-9_$]@<![A-Z_][A-Z_][A-Z0-9_]*:[=]@!/
syn match ncvetNumberOfBlock /\v[A-Za-z0-9_$]@<![N:][0-9]+[A-Za-z_]@!/
syn match ncvetTape /\v\%[0-9A-Za-z_]@!/
syn match ncvetProgram /\v[A-Za-z_$#>]@<!\%_N_[A-Z0-9_]+/
syn match ncvetString /"[^"]*\("\|$\)/
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
hi def link ncvetString String
hi def link ncvetSymbol Constant
hi def link ncvetTape PreProc
hi def link ncvetType Type
hi def link ncvetVariable Identifier
let b:current_syntax = 'ncvet-sinumerik'
