// A headless Chromium that a test steers through the DevTools protocol, over a pair of pipes.
#pragma once

#include "unit/test_folder.h"

#include <nlohmann/json.hpp>

#include <string>
#include <sys/types.h>
#include <vector>

namespace strandlab::testing_tools {

using Json = nlohmann::ordered_json;

/// The program: $STRANDLAB_CHROMIUM, else chromium, chromium-browser or google-chrome on the PATH; empty
/// where there is none.
std::string find_chromium();

/// One browser with one page. Everything throws std::runtime_error when the browser does not answer within a
/// minute.
class Chromium {
  public:
    explicit Chromium(const std::string& program);
    ~Chromium();
    Chromium(const Chromium&) = delete;
    Chromium& operator=(const Chromium&) = delete;

    void resize(int width, int height);
    /// prefers-color-scheme.
    void use_dark(bool dark);
    /// Opens a file and waits until page.js has done its work.
    void open(const std::string& path);
    /// The value of an expression, or of the promise that it is. Throws when it throws.
    Json evaluate(const std::string& expression);
    /// "mouseMoved", "mousePressed", "mouseReleased" or "mouseWheel" (upwards).
    void mouse(const std::string& type, double x, double y);
    /// Scrolls the first element of a selector into view; returns the place [x, y] of its middle.
    Json show(const std::string& selector);
    /// Presses and releases there.
    void click(const std::string& selector);
    void press_key(const std::string& key);
    /// A PNG file of what is seen.
    std::string screenshot();
    /// Answers a command of the page.
    Json command(const std::string& method, const Json& parameters = Json::object());

    /// Errors, warnings and messages of the console since open, and exceptions.
    std::vector<std::string> messages();
    /// Addresses that the page asked for, without those of data.
    std::vector<std::string> requests();

  private:
    Json call(const std::string& method, const Json& parameters);
    Json next_message();
    void keep(const Json& message);

    TestFolder profile_;
    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
    int last_id_ = 0;
    std::string buffer_, session_;
    std::vector<Json> events_;
};

}  // namespace strandlab::testing_tools
