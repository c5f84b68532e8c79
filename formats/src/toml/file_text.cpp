#include "toml/file_text.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "talus/formats/inputs.h"
#include "toml/wording.h"

namespace talus::formats::toml {

namespace {

constexpr std::size_t kMaxFileSize = std::size_t{64} << 20;  // [bytes]

Error fileError(const std::string& path, std::string message) { return {"", std::move(message), path}; }

/// Counted while reading: devices and pipes do not tell their size.
Result<std::string> readAll(std::FILE* file, const std::string& name) {
    std::string text;
    std::array<char, 1 << 16> chunk;
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file)) {
        if (text.size() + count > kMaxFileSize)
            return fileError(name, "is larger than 64 MiB, allowed: at most that");
        text.append(chunk.data(), count);
    }
    if (std::ferror(file)) return fileError(name, std::string("cannot be read: ") + std::strerror(errno));
    return text;
}

}  // namespace

Result<std::string> readFileText(const std::string& path) {
    // The system would end the name there and open another file.
    if (path.find('\0') != std::string::npos)
        return fileError(oneLine(path), "has a NUL in its name, allowed: a name without");
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return fileError(path, "found a directory, allowed: a file");
    errno = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) return fileError(path, std::string("cannot be opened: ") + std::strerror(errno));
    rememberInput(path);
    return readAll(file.get(), path);
}

Result<std::string> readStandardInput(const std::string& name) {
    rememberInput("/dev/stdin");  // a file that the shell put there is an input, too
    return readAll(stdin, name);
}

}  // namespace talus::formats::toml
