; The bracket of a loop's head is lost
G21 G17 G90 G40 G49 G80 G54
T1 M6
G43
S1200 M3
G0 X0 Y0 Z5
#1=0
o10 while #1 LT 5]
(          ^^^^^^^^ expect: syntax-error definite)
G0 X[10*#1]
#1=[#1+1]
o10 endwhile
G0 Z50
M5
M2
