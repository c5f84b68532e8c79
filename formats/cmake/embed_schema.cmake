# Turns the binary schema into a C++ array. Usage: cmake -D INPUT=x.bfbs -D OUTPUT=x.h -P embed_schema.cmake
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(0x[0-9a-f][0-9a-f],0x[0-9a-f][0-9a-f],0x[0-9a-f][0-9a-f],0x[0-9a-f][0-9a-f],)" "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT} "#pragma once\n// Made from snapshot.fbs.\nnamespace talus::formats {\n"
    "inline constexpr unsigned char kSnapshotSchema[] = {\n${bytes}};\n}\n")
