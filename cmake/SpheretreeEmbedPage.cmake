# SPDX-License-Identifier: Apache-2.0
# Makes the source file of a page from its parts:
#
#   cmake -DPAGE=folder -DSCRIPTS=a.js,b.js -DOUTPUT=file -P SpheretreeEmbedPage.cmake
#
# index.html has a line for each of @STYLE@, @DATA@ and @SCRIPT@. style.css and the scripts, in the order
# given, take the place of the first and the last; the page is cut in two at the data.

# A file, or a part of one, as a string of C++. One literal a file: compilers have limits.
function(to_literal text result)
    if(text MATCHES "[)]page\"")
        message(FATAL_ERROR "a file of ${PAGE} has )page\" in it, which ends a literal")
    endif()
    set(${result} "    R\"page(${text})page\",\n" PARENT_SCOPE)
endfunction()

file(READ "${PAGE}/index.html" html)
set(rest "${html}")
foreach(mark IN ITEMS STYLE DATA SCRIPT)
    string(FIND "${rest}" "@${mark}@\n" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "${PAGE}/index.html has no line @${mark}@")
    endif()
    string(SUBSTRING "${rest}" 0 ${at} before)
    to_literal("${before}" before_${mark})
    string(LENGTH "@${mark}@\n" length)
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${rest}" ${at} -1 rest)
endforeach()
to_literal("${rest}" end)

file(READ "${PAGE}/style.css" style)
to_literal("${style}" style)
set(scripts "")
string(REPLACE "," ";" names "${SCRIPTS}")
foreach(name IN LISTS names)
    file(READ "${PAGE}/${name}" script)
    to_literal("${script}" script)
    string(APPEND scripts "${script}")
endforeach()

file(WRITE "${OUTPUT}" "// Made from ${PAGE} by cmake/SpheretreeEmbedPage.cmake.
#include <openvdb_spheretree/viewer/ViewerPage.h>

namespace openvdb_spheretree::detail {

const char* const kPageBeforeData[] = {
${before_STYLE}${style}${before_DATA}    nullptr};

const char* const kPageAfterData[] = {
${before_SCRIPT}${scripts}${end}    nullptr};

} // namespace openvdb_spheretree::detail
")
