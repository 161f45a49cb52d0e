# Writes OUT/man1/*.1.gz, a manual page for COMMAND and for each of its subcommands, and OUT/spincat.{bash,zsh,fish}.
cmake_minimum_required(VERSION 3.24)

foreach(shell bash zsh fish)
  execute_process(COMMAND ${COMMAND} completion ${shell} OUTPUT_FILE ${OUT}/spincat.${shell} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

file(REMOVE_RECURSE ${OUT}/man1)
file(MAKE_DIRECTORY ${OUT}/man1)

function(write_page words summary)
  string(REPLACE " " "-" page "${words}")
  string(REPLACE "spincat" "${COMMAND}" line "${words}")
  execute_process(COMMAND ${HELP2MAN} --no-info --no-discard-stderr --name=${summary} --version-string=${VERSION}
                          --source=spincat --output=${OUT}/man1/${page}.1 ${line} COMMAND_ERROR_IS_FATAL ANY)
  # It takes the first word alone for the name.
  string(TOUPPER "${page}" title)
  file(READ ${OUT}/man1/${page}.1 text)
  string(REPLACE ".TH SPINCAT " ".TH ${title} " text "${text}")
  string(REPLACE "\n${words} \\- " "\n${page} \\- " text "${text}")
  file(WRITE ${OUT}/man1/${page}.1 "${text}")
  execute_process(COMMAND gzip -9n ${OUT}/man1/${page}.1 COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write_page("spincat" "learn object categories from 3D models, and name new ones")
# The lines below "Subcommands:" have a name and what it does; longer texts go on with more blanks.
execute_process(COMMAND ${COMMAND} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\nSubcommands:\n" "" list "${help}")
string(REGEX REPLACE "\n\n.*" "" list "${list}")
string(REGEX REPLACE "\n   +" " " list "${list}")
string(REPLACE ";" "," list "${list}")
string(REPLACE "\n" ";" list "${list}")
foreach(row ${list})
  if(row MATCHES "^  ([a-z]+) +(.*)")
    set(name ${CMAKE_MATCH_1})
    string(STRIP "${CMAKE_MATCH_2}" summary)
    string(SUBSTRING "${summary}" 0 1 first)
    string(SUBSTRING "${summary}" 1 -1 rest)
    string(TOLOWER ${first} first)
    write_page("spincat ${name}" "${first}${rest}")
  endif()
endforeach()
