# SPDX-License-Identifier: Apache-2.0
# cmake -DPAGE=<file> -DSOURCE=<file> -P CheckExample.cmake
# Fails unless the page shows the program in SOURCE as it is, from its first #include on.
file(READ "${PAGE}" page)
file(READ "${SOURCE}" program)
string(FIND "${program}" "#include" start)
string(SUBSTRING "${program}" ${start} -1 program)
string(FIND "${page}" "```cpp\n${program}```\n" place)
if(start EQUAL -1 OR place EQUAL -1)
    message(FATAL_ERROR "${PAGE} does not show ${SOURCE} as it is: copy it there again.")
endif()
