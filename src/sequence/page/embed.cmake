# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT: the parts of the page (FOLDER, CHART) as C++ strings, each with its SHA-256, by which
# the page's Content-Security-Policy lets them, and nothing else, run; and what THIRD_PARTY says of
# Chart.js, as HTML.
cmake_minimum_required(VERSION 3.25)
set(scripts model.js pixels.js curve.js panes.js values.js viewer.js decisions.js approve.js attribution.js facts.js lists.js page.js)

include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/embed_text.cmake)

function(add_text name text)
  embed_text(${name} "${text}")
  string(SHA256 hash "${text}")
  string(APPEND code "const char* const ${name}_hash = \"${hash}\";\n")
  set(code "${code}" PARENT_SCOPE)
endfunction()

file(READ "${FOLDER}/page.html" html)
file(READ "${FOLDER}/page.css" style)
file(READ "${CHART}" chart)
set(script "")
foreach(name IN LISTS scripts)
  file(READ "${FOLDER}/${name}" text)
  string(APPEND script "${text}")
endforeach()
foreach(part IN ITEMS style chart script)
  string(TOLOWER "${${part}}" lower)
  if(lower MATCHES "</(script|style)")
    message(FATAL_ERROR "${part} of the report's page holds an end tag")
  endif()
endforeach()

# From the heading of Chart.js to that of the first one that is not a part of it.
file(READ "${THIRD_PARTY}" licences)
string(FIND "${licences}" "\n## Chart.js\n" begin)
string(FIND "${licences}" "\n## nlohmann/json\n" end)
if(begin LESS 0 OR end LESS begin)
  message(FATAL_ERROR "${THIRD_PARTY} does not have the licences of Chart.js before nlohmann/json's")
endif()
math(EXPR length "${end} - ${begin}")
string(SUBSTRING "${licences}" ${begin} ${length} licences)
string(REGEX REPLACE "\n(## |```text|```)" "\n" licences "${licences}")
# The page names no other place, not even in a text.
string(REGEX REPLACE "https?://" "" licences "${licences}")
string(REPLACE "&" "&amp;" licences "${licences}")
string(REPLACE "<" "&lt;" licences "${licences}")
string(REPLACE ">" "&gt;" licences "${licences}")

set(code "// Made by embed.cmake.\n#include \"sequence/page/files.h\"\n\n")
string(APPEND code "namespace tonetool::sequence::page {\n\n")
embed_text(html "${html}")
add_text(style "${style}")
add_text(script "${script}")
add_text(chart "${chart}")
embed_text(licences "${licences}")
string(APPEND code "\n} // namespace tonetool::sequence::page\n")
file(WRITE "${OUT}" "${code}")
