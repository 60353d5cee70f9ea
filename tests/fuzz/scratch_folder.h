// Files for readers that take a path: in memory where the system offers it, gone with the process.
#pragma once

#include "fuzz/fuzz_target.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace strandlab::fuzz {

class ScratchFolder {
  public:
    ScratchFolder() {
        const std::filesystem::path memory = "/dev/shm";
        const auto root =
            ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
        folder_ = root / ("strandlab-fuzz-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return folder_; }

    /// Writes a file and returns its path.
    std::string write(const std::filesystem::path& name, Bytes bytes) const {
        const std::string path = (folder_ / name).string();
        std::FILE* const file = std::fopen(path.c_str(), "wb");
        require(file != nullptr, "the scratch folder cannot be written: " + path);
        std::fwrite(bytes.data(), 1, bytes.size(), file);
        std::fclose(file);
        return path;
    }

  private:
    std::filesystem::path folder_;
};

/// The process's own.
inline const ScratchFolder& scratch_folder() {
    static const ScratchFolder folder;
    return folder;
}

}  // namespace strandlab::fuzz
