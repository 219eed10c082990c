# SPDX-License-Identifier: BSD-3-Clause
# For scripts that write sources at build time: appends a text as a C++ string NAME to `code`.
function(embed_text name text)
  # Compilers have a limit for one literal.
  string(LENGTH "${text}" length)
  set(at 0)
  set(pieces "")
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 12000 piece)
    string(APPEND pieces "\n    R\"~page~(${piece})~page~\"")
    math(EXPR at "${at} + 12000")
  endwhile()
  set(code "${code}const char* const ${name} =${pieces};\n" PARENT_SCOPE)
endfunction()
