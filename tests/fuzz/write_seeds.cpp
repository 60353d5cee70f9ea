// Prints the names of all targets; fuzz_seeds FOLDER also writes their seeds, FOLDER/hair/seed0 and so on.
#include "base/error.h"
#include "base/file.h"
#include "fuzz/fuzz_target.h"

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
    using namespace strandlab;
    if (argc > 2) {
        std::cerr << "usage: fuzz_seeds [FOLDER]\n";
        return static_cast<int>(ExitCode::usage);
    }
    try {
        for (const fuzz::FuzzTarget& target : fuzz::fuzz_targets()) {
            std::cout << target.name << '\n';
            if (argc < 2) continue;
            const auto folder = std::filesystem::path(argv[1]) / target.name;
            std::filesystem::create_directories(folder);
            size_t index = 0;
            for (const std::string& seed : target.seeds())
                write_file((folder / ("seed" + std::to_string(index++))).string(), seed);
        }
    } catch (const std::exception& error) {
        std::cerr << "fuzz_seeds: " << error.what() << "\n";
        return static_cast<int>(ExitCode::bad_input);
    }
    return 0;
}
