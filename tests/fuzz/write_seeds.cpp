// Writes the seed corpus: fuzz_seeds FOLDER makes FOLDER/hair/0 and so on.
#include "base/error.h"
#include "base/file.h"
#include "fuzz/samples.h"

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
    using namespace strandlab;
    if (argc != 2) {
        std::cerr << "usage: fuzz_seeds FOLDER\n";
        return static_cast<int>(ExitCode::usage);
    }
    try {
        int index = 0;
        for (const samples::Sample& sample : samples::all()) {
            std::vector<std::string> folders{sample.extension.substr(1)};
            if (sample.extension == ".npy") folders.push_back("npy_strands");
            for (const std::string& folder : folders) {
                const auto path = std::filesystem::path(argv[1]) / folder;
                std::filesystem::create_directories(path);
                write_file(path / std::to_string(index++), sample.bytes);
            }
        }
    } catch (const std::exception& error) {
        std::cerr << "fuzz_seeds: " << error.what() << "\n";
        return static_cast<int>(ExitCode::bad_input);
    }
    return 0;
}
