# Makes the comment that a header opens with the description of its file, and keeps Doxygen from
# taking #words of GLSL for links.
FNR == 1 && /^\/\/[^\/]/ { print "/// @file"; head = 1 }
head && /^\/\// { print "/" $0; next }
{ head = 0 }
/\/\/\// { gsub(/#/, "\\#") }
{ print }
