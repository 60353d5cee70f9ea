#include "commands/usage_error.h"

#include "base/error.h"
#include "base/text.h"

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
    const auto guess = nearest(word, names);
    return guess ? fmt::format(", did you mean '{}'?", *guess) : "";
}

/// CLI11's message, of which only this one needs other words.
std::string text_of(const CLI::ParseError& error) {
    constexpr std::string_view start = "Could not convert: ";
    const std::string text = error.what();
    if (text.rfind(start, 0) != 0) return text;
    return text.substr(start.size()) + " is not a number that this option takes";
}

}  // namespace

void fail_usage(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
    const std::string help = command ? "strandlab " + command->get_name() + " --help" : "strandlab --help";
    // A word that nobody understood is the likeliest reason for whatever else is missing.
    const std::vector<std::string> unknown = app.remaining(true);
    for (std::string word : unknown) {
        if (word.size() < 2 || word[0] != '-') continue;
        word = word.substr(0, word.find('='));
        std::vector<std::string> names;
        if (command) add_option_names(*command, names);
        add_option_names(app, names);
        fail(ExitCode::usage, "no option '{}'{}; see {}", word, suggestion(word, names), help);
    }
    const std::vector<std::string> commands = command_names(app);
    const bool lacks_command = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (!command && unknown.empty() && lacks_command)
        fail(ExitCode::usage, "no command; there are {}; see {}", list_of(commands, "and"), help);
    if (!command && !unknown.empty())
        fail(ExitCode::usage, "no command '{}'{}; there are {}", unknown.front(),
             suggestion(unknown.front(), commands), list_of(commands, "and"));
    if (command && !unknown.empty())
        fail(ExitCode::usage, "'{}': {} takes no such argument; see {}", unknown.front(), command->get_name(),
             help);
    fail(ExitCode::usage, "{}; see {}", text_of(error), help);
}

CLI::Validator whole_number(uint64_t low, uint64_t high) {
    const auto check = [low, high](const std::string& text) -> std::string {
        uint64_t number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && end == text.data() + text.size() && number >= low && number <= high)
            return {};
        return fmt::format("{} is not a whole number from {} to {}", text, low, high);
    };
    return {check, "", "whole number"};
}

}  // namespace strandlab
