# clang++ describes constants that no object file keeps.
set print static-members off
set pagination off
set confirm off
set width 0
break stepping.frag:11
run
next
print a
step
next
print sum
next
next
next
next
next
next
print b
next
next
print b
delete
continue
