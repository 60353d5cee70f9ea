#include "browser/chromium.h"

#include "base/text.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace strandlab::testing_tools {
namespace {

constexpr int patience_ms = 60'000;

/// Bytes that DevTools sent in base64.
std::string decoded(const std::string& base64) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    uint32_t bits = 0;
    int count = 0;
    for (const char c : base64) {
        const size_t digit = digits.find(c);
        if (digit == std::string::npos) break;
        bits = (bits << 6) | static_cast<uint32_t>(digit);
        if (++count % 4 != 1) bytes += static_cast<char>((bits >> (6 - 2 * ((count - 1) % 4))) & 0xFF);
    }
    return bytes;
}

/// In the child: file descriptors 3 and 4 are the browser's ends of the pipes.
[[noreturn]] void run_browser(const std::string& program, const std::string& profile, int in, int out) {
    // Out of the way of 3 and 4 first.
    const int safe_in = ::fcntl(in, F_DUPFD, 10), safe_out = ::fcntl(out, F_DUPFD, 10);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (int i = 0; i < 3; ++i) ::dup2(nothing, i);
    ::dup2(safe_in, 3);
    ::dup2(safe_out, 4);
    ::close(safe_in);
    ::close(safe_out);
    const std::string data = "--user-data-dir=" + profile;
    // The page is the test's own file: no sandbox is needed, and in containers none can be had.
    ::execl(program.c_str(), program.c_str(), "--headless", "--no-sandbox", "--disable-gpu",
            "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run",
            "--remote-debugging-pipe", data.c_str(), "about:blank", static_cast<char*>(nullptr));
    ::_exit(127);
}

}  // namespace

std::string find_chromium() {
    if (const char* chosen = std::getenv("STRANDLAB_CHROMIUM")) return chosen;
    const char* path = std::getenv("PATH");
    for (const std::string_view folder : split(path ? path : "", ':'))
        for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
            const std::string program = std::string(folder) + "/" + name;
            if (::access(program.c_str(), X_OK) == 0) return program;
        }
    return "";
}

Chromium::Chromium(const std::string& program) {
    int to[2], from[2];
    if (::pipe2(to, O_CLOEXEC) != 0 || ::pipe2(from, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ == 0) run_browser(program, profile_ / "profile", to[0], from[1]);
    ::close(to[0]);
    ::close(from[1]);
    to_ = to[1];
    from_ = from[0];
    std::signal(SIGPIPE, SIG_IGN);
    const Json target = call("Target.createTarget", {{"url", "about:blank"}});
    session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                   .at("sessionId")
                   .get<std::string>();
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) command(std::string(domain) + ".enable");
}

Chromium::~Chromium() {
    ::close(to_);  // the browser ends when its pipe does
    ::close(from_);
    for (int i = 0; i < 100; ++i) {
        if (::waitpid(process_, nullptr, WNOHANG) != 0) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

Json Chromium::next_message() {
    size_t end;
    while ((end = buffer_.find('\0')) == std::string::npos) {
        pollfd wait{from_, POLLIN, 0};
        char bytes[65536];
        const ssize_t count = ::poll(&wait, 1, patience_ms) > 0 ? ::read(from_, bytes, sizeof(bytes)) : 0;
        if (count <= 0) throw std::runtime_error("the browser does not answer");
        buffer_.append(bytes, static_cast<size_t>(count));
    }
    Json message = Json::parse(buffer_.substr(0, end));
    buffer_.erase(0, end + 1);
    return message;
}

void Chromium::keep(const Json& message) {
    if (message.contains("method")) events_.push_back(message);
}

Json Chromium::call(const std::string& method, const Json& parameters) {
    Json request{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) request["sessionId"] = session_;
    const std::string bytes = request.dump() + '\0';
    for (size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = ::write(to_, bytes.data() + sent, bytes.size() - sent);
        if (count <= 0) throw std::runtime_error("the browser has gone");
        sent += static_cast<size_t>(count);
    }
    while (true) {
        const Json message = next_message();
        keep(message);
        if (message.value("id", 0) != last_id_) continue;
        if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
        return message.value("result", Json::object());
    }
}

Json Chromium::command(const std::string& method, const Json& parameters) { return call(method, parameters); }

void Chromium::resize(int width, int height) {
    command("Emulation.setDeviceMetricsOverride",
            {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Chromium::use_dark(bool dark) {
    const Json feature{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
    command("Emulation.setEmulatedMedia", {{"features", Json::array({feature})}});
}

void Chromium::open(const std::string& path) {
    events_.clear();
    command("Page.navigate", {{"url", "file://" + path}});
    evaluate(
        "new Promise(done => { const look = () => document.body && document.body.dataset.ready ? done(1) "
        ": setTimeout(look, 20); look(); })");
}

Json Chromium::evaluate(const std::string& expression) {
    const Json answer = command(
        "Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (answer.contains("exceptionDetails")) throw std::runtime_error(answer["exceptionDetails"].dump());
    return answer.at("result").value("value", Json());
}

void Chromium::mouse(const std::string& type, double x, double y) {
    Json event{{"type", type}, {"x", x}, {"y", y}};
    if (type == "mousePressed" || type == "mouseReleased")
        event.update({{"button", "left"}, {"clickCount", 1}});
    if (type == "mouseWheel") event.update({{"deltaX", 0}, {"deltaY", -240}});
    command("Input.dispatchMouseEvent", event);
}

Json Chromium::show(const std::string& selector) {
    const std::string element = "document.querySelector(" + Json(selector).dump() + ")";
    evaluate(element + ".scrollIntoView({block: 'center', behavior: 'instant'})");
    // What comes of scrolling comes with the next frames.
    evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
    return evaluate("(() => { const b = " + element +
                    ".getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()");
}

void Chromium::click(const std::string& selector) {
    const Json place = show(selector);
    for (const char* type : {"mouseMoved", "mousePressed", "mouseReleased"}) mouse(type, place[0], place[1]);
}

void Chromium::press_key(const std::string& key) {
    for (const char* type : {"keyDown", "keyUp"})
        command("Input.dispatchKeyEvent", {{"type", type}, {"key", key}, {"code", key}});
}

std::string Chromium::screenshot() {
    return decoded(command("Page.captureScreenshot").at("data").get<std::string>());
}

std::vector<std::string> Chromium::messages() {
    evaluate("1");  // what was on its way is here now
    std::vector<std::string> texts;
    for (const Json& event : events_)
        for (const char* kind : {"Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded"})
            if (event["method"] == kind) texts.push_back(event["params"].dump());
    return texts;
}

std::vector<std::string> Chromium::requests() {
    evaluate("1");
    std::vector<std::string> addresses;
    for (const Json& event : events_) {
        if (event["method"] != "Network.requestWillBeSent") continue;
        const std::string address = event["params"]["request"]["url"].get<std::string>();
        if (!address.starts_with("data:") && !address.starts_with("blob:")) addresses.push_back(address);
    }
    return addresses;
}

}  // namespace strandlab::testing_tools
