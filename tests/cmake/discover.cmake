# cmake -D PROGRAM=<talus-tests> -D TESTS_DIR=<tests/> -D OUTPUT=<file.cmake> -D FAST_TIMEOUT=<s> -P discover.cmake
# Asks the program for its tests and writes one CTest entry per source file, and one more, labelled slow, for the file's
# suites whose names start with "slow". By file, because file names are tame where test names hold commas and brackets.
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml
    OUTPUT_VARIABLE listing RESULT_VARIABLE status)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} cannot list its tests (${status}):\n${listing}")
endif()

set(fast_files "")
set(slow_files "")
# Names of tests and suites may hold what CMake would take for the end of a list's element.
string(REGEX REPLACE " testsuite=\"slow[^\"]*\"" " slow" listing "${listing}")
string(REGEX REPLACE " (name|testsuite)=\"[^\"]*\"" "" listing "${listing}")
string(REGEX MATCHALL "<TestCase [^>]*>" cases "${listing}")
foreach(case IN LISTS cases)
    if(NOT case MATCHES " filename=\"([^\"]*)\"")
        message(FATAL_ERROR "A test without a file: ${case}")
    endif()
    set(file ${CMAKE_MATCH_1})
    if(IS_ABSOLUTE ${file})
        file(RELATIVE_PATH file ${TESTS_DIR} ${file})
    else()  # ccache shortens paths below its base_dir
        string(REGEX REPLACE "^(\\.\\./)*tests/" "" file ${file})
    endif()
    if(case MATCHES " slow ")
        list(APPEND slow_files ${file})
    else()
        list(APPEND fast_files ${file})
    endif()
endforeach()

set(text "")
function(add_entry name file suites properties)
    string(APPEND text "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--source-file=*/tests/${file}]==] ${suites})\n"
        "set_tests_properties([==[${name}]==] PROPERTIES ${properties})\n")
    set(text "${text}" PARENT_SCOPE)
endfunction()

list(REMOVE_DUPLICATES fast_files)
list(REMOVE_DUPLICATES slow_files)
foreach(file IN LISTS fast_files)
    string(REGEX REPLACE "(_test)?\\.cpp$" "" name ${file})
    add_entry(${name} ${file} "--test-suite-exclude=slow*" "TIMEOUT ${FAST_TIMEOUT}")
endforeach()
# The longest begin first: else one of them runs on alone at the end. [s, about]
set(cost_of_physics/large_displacement 460)
set(cost_of_tools/recording/attacks 240)
set(cost_of_physics/impacts 90)
foreach(file IN LISTS slow_files)
    string(REGEX REPLACE "(_test)?\\.cpp$" "" name ${file})
    set(cost 0)
    if(DEFINED cost_of_${name})
        set(cost ${cost_of_${name}})
    endif()
    add_entry(${name}/slow ${file} "--test-suite=slow*" "LABELS slow TIMEOUT 3000 COST ${cost}")
endforeach()
file(WRITE ${OUTPUT} "${text}")
