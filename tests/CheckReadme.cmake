# SPDX-License-Identifier: Apache-2.0
# cmake -DREADME=<file> -DSOURCE=<file> -P CheckReadme.cmake
# Fails unless the README shows the program in SOURCE as it is, from its first #include on.
file(READ "${README}" readme)
file(READ "${SOURCE}" program)
string(FIND "${program}" "#include" start)
string(SUBSTRING "${program}" ${start} -1 program)
string(FIND "${readme}" "```cpp\n${program}```\n" place)
if(start EQUAL -1 OR place EQUAL -1)
    message(FATAL_ERROR "${README} does not show ${SOURCE} as it is: copy it there again.")
endif()
