# Run by `cmake --install`: copies the public headers, and what they include, to include/relief/.
# In this tree headers include each other by their path from its root ("common/patch.h"); installed
# ones do so as <relief/common/patch.h>, so that a user needs include/ on the path and nothing else.
# What is in integrations/ is installed at the top, as <relief/pcl.h>.
# Takes SOURCE (the tree), STAGE (an empty folder to make them in), DESTINATION, and HEADERS.
# An install script inherits no policies.
cmake_policy(VERSION 3.25)
set(INCLUDE_LINE "^#include \"([^\"]+)\"")

set(waiting ${HEADERS})
set(public)
while(waiting)
  list(POP_FRONT waiting header)
  if(header IN_LIST public)
    continue()
  endif()
  list(APPEND public ${header})
  file(STRINGS ${SOURCE}/${header} lines REGEX ${INCLUDE_LINE})
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "${INCLUDE_LINE}.*" "\\1" included "${line}")
    list(APPEND waiting ${included})
  endforeach()
endwhile()

file(REMOVE_RECURSE ${STAGE})
foreach(header IN LISTS public)
  file(READ ${SOURCE}/${header} text)
  string(REGEX REPLACE "(\n#include )\"([^\"]+)\"" "\\1<relief/\\2>" text "${text}")
  string(REGEX REPLACE "^integrations/" "" installed "${header}")
  file(WRITE ${STAGE}/${installed} "${text}")
endforeach()
file(INSTALL ${STAGE}/ DESTINATION ${DESTINATION})
