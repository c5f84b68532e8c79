# cmake -D SOURCE=<checkout> -D OUTPUT=<file.cpp> -P git_hash.cmake
# Writes the commit into OUTPUT, and leaves the file alone when nothing changed. "unknown" where there is no git, no
# commit, or where SOURCE is a source archive unpacked inside somebody else's repository.

# safe.directory: a checkout that belongs to another user is still the one being compiled.
function(git result)
    execute_process(COMMAND git --no-optional-locks -c safe.directory=* -C ${SOURCE} ${ARGN}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT status EQUAL 0)
        set(output NOTFOUND)
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

set(hash unknown)
git(prefix rev-parse --show-prefix)  # empty in the top folder of a checkout
git(commit rev-parse --verify --short=12 HEAD)
if(prefix STREQUAL "" AND commit)
    git(changes status --porcelain)
    set(hash ${commit})
    if(NOT changes STREQUAL "")
        string(APPEND hash "-dirty")
    endif()
endif()

set(text "namespace talus {\nextern const char kGitHash[];\nconst char kGitHash[] = \"${hash}\";\n}  // namespace talus\n")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
endif()
if(NOT text STREQUAL "${old}")
    file(WRITE ${OUTPUT} "${text}")
endif()
