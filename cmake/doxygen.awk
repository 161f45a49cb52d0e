# Makes Doxygen's comments of the plain ones of the public headers, as its INPUT_FILTER.
{
  at = index($0, "//")
  if (at == 0 || $0 ~ /^ *}/ || $0 ~ /NOLINT/) {  # no comment, one behind the end of a block, or one for clang-tidy
    behind = 0
    print
    next
  }
  code = substr($0, 1, at - 1)
  text = substr($0, at + 2)
  # Signs that Doxygen takes for HTML or for commands stand for themselves.
  gsub(/&/, "\\&amp;", text)
  gsub(/</, "\\&lt;", text)
  gsub(/>/, "\\&gt;", text)
  gsub(/[\\@#%]/, "\\\\&", text)
  # Behind a declaration, or the next line of such a comment.
  behind = code !~ /^ *$/ ? at : (at == behind ? at : 0)
  if (NR == 1) {
    print "/// \\file"  # what a file begins with is about the file
  }
  print code (behind ? "///<" : "///") text
}
