// Options of the form key=value,..., of primitives and of generators, described once: parser, help and report
// read the table.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// One parameter: either a number in [low, high] (whole when integer is set) or one of choices.
struct ParameterInfo {
    std::string name;
    std::string help;           // one line, with the unit
    std::string default_value;  // as the user would write it
    double low = 0, high = 0;
    bool integer = false;
    std::vector<std::string> choices;  // when not empty, the value is one of these words
};

/// Values of all parameters of a table, all present and checked.
class Parameters {
  public:
    /// Defaults of a table.
    explicit Parameters(const std::vector<ParameterInfo>& table);

    /// Sets a value; throws Error (usage) that begins with context (such as "--primitive lss") and names
    /// key and value, with the nearest key or the allowed range.
    void set(std::string_view context, const std::vector<ParameterInfo>& table, std::string_view key,
             std::string_view value);

    /// Sets every key=value of a text that separates them by commas; throws as set does.
    void set_all(std::string_view context, const std::vector<ParameterInfo>& table, std::string_view text);

    double number(const std::string& name) const;
    uint32_t integer(const std::string& name) const { return static_cast<uint32_t>(number(name)); }
    const std::string& text(const std::string& name) const { return values_.at(name); }
    bool is(const std::string& name, std::string_view value) const { return values_.at(name) == value; }

    /// "key=value,key=value" of what differs from the defaults of the table (all keys when all is set).
    std::string to_string(const std::vector<ParameterInfo>& table, bool all = false) const;

  private:
    std::map<std::string, std::string> values_;
};

}  // namespace strandlab
