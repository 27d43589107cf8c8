# SPDX-License-Identifier: BSD-3-Clause
# Writes a ctest test for each suite of a program of GoogleTest, and for each of its tests whose name
# matches ALONE. Most tests are shorter than the start of a process.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests "--gtest_filter=${FILTER}"
  OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[^\n]*gtest_main[^\n]*\n" "" listed "${listed}")
string(REGEX REPLACE " +#[^\n]*" "" listed "${listed}") # the types of typed tests
string(REGEX MATCHALL "[^\n]+" listed "${listed}")

set(suites)
set(alone)
foreach (line IN LISTS listed)
  if (NOT line MATCHES "^  ")
    set(prefix "${line}")
    string(REGEX REPLACE "(/[0-9]+)?[.]$" "" suite "${line}")
    continue ()
  endif ()
  string(STRIP "${line}" test)
  string(PREPEND test "${prefix}")
  if (test MATCHES "${ALONE}")
    list(APPEND suites "${test}")
    list(APPEND alone "${test}")
    set("filter_${test}" "${test}")
  else ()
    list(APPEND suites "${suite}")
    string(APPEND "filter_${suite}" "${test}:")
  endif ()
endforeach ()
list(REMOVE_DUPLICATES suites)

set(text "")
foreach (suite IN LISTS suites)
  set(name "[==[core.${suite}${SUFFIX}]==]")
  string(APPEND text
    "add_test(${name} [==[${PROGRAM}]==] [==[--gtest_filter=${filter_${suite}}]==])\n"
    "set_tests_properties(${name} PROPERTIES ${PROPERTIES} FAIL_REGULAR_EXPRESSION [==[Running 0 tests]==])\n")
  if (suite IN_LIST alone) # of a suite, it would hide the failure of another test
    string(APPEND text
      "set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==])\n")
  endif ()
endforeach ()
file(WRITE "${OUTPUT}" "${text}")
