#pragma once
// Files of a test, in a folder of their own that is gone with it.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace talus::test {

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "talus-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) std::abort();  // nothing can be tested
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string path() const { return path_.string(); }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return *this / name;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

 private:
    std::filesystem::path path_;
};

/// One file of this name in a folder of its own.
class TemporaryFile {
 public:
    TemporaryFile(const std::string& name, const std::string& bytes) : path_(folder_.write(name, bytes)) {}

    const std::string& path() const { return path_; }
    std::string folder() const { return folder_.path(); }

 private:
    TemporaryFolder folder_;
    std::string path_;
};

}  // namespace talus::test
