// A sweep of bench that tests run, and what they read of its rows.
#pragma once

#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace strandlab::testing_tools {

using Json = nlohmann::json;

class SweepTest : public CommandLineTest {
  protected:
    /// A sweep of 2 models, 2 ray sets and 4 primitives: 16 cases.
    static constexpr size_t cases = 16;

    Arguments sweep(const Arguments& more) const {
        Arguments arguments{"bench",
                            "generate:fur,strands=60",
                            "generate:fur,strands=40",
                            "--device",
                            "cpu-float",
                            "--resolution",
                            "40x24",
                            "--repeat",
                            "2",
                            "--rays",
                            "primary",
                            "--rays",
                            "interior",
                            "--primitive",
                            "lss:segments=1,2",
                            "--primitive",
                            "prhi:splits=1..2",
                            "--no-embree"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    std::vector<Json> rows(const std::string& name) const {
        std::vector<Json> all;
        std::istringstream stream(read(name));
        for (std::string line; std::getline(stream, line);) {
            EXPECT_TRUE(Json::accept(line)) << name << ": " << line.substr(0, 200);
            if (Json::accept(line)) all.push_back(Json::parse(line));
        }
        return all;
    }

    void write_rows(const std::string& name, const std::vector<Json>& all) const {
        std::string text;
        for (const Json& row : all) text += row.dump() + "\n";
        write(name, text);
    }

    /// The keys of all rows; fails the test where one is there twice.
    std::set<std::string> keys(const std::string& name) const {
        std::set<std::string> all;
        for (const Json& row : rows(name)) EXPECT_TRUE(all.insert(row.at("key")).second) << row.at("key");
        return all;
    }
};

}  // namespace strandlab::testing_tools
