// The default benchmark from end to end: it runs, and its report opens in headless Chromium and works.
#include "base/file.h"
#include "browser/chromium.h"
#include "command_line/program.h"

#include <fmt/format.h>

#include <cstdlib>

namespace strandlab::testing_tools {
namespace {

class DefaultSweepTest : public CommandLineTest {
  protected:
    /// The default sweep: all of it in long tests, else with few rays.
    void run_sweep() const {
        Arguments arguments{"bench", "--json", "rows.jsonl", "--images", "pictures"};
        if (std::getenv("STRANDLAB_LONG_TESTS") == nullptr)
            arguments.insert(arguments.end(),
                             {"--resolution", "64x36", "--repeat", "2", "--error-rays", "300"});
        if (!why_no_device().empty()) arguments.insert(arguments.end(), {"--device", "cpu-float"});
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.code, 0) << outcome.log;
        const Outcome page = run({"report", "rows.jsonl", "-o", "report.html", "--figures", "figures"});
        ASSERT_EQ(page.code, 0) << page.log;
        EXPECT_EQ(page.log.find("goes without"), std::string::npos) << page.log;
    }

    static int count(Chromium& browser, const std::string& selector) {
        return browser.evaluate("document.querySelectorAll('" + selector + "').length").get<int>();
    }
    /// Every panel of a section has that many charts, and each of them marks of some rows.
    static void expect_charts(Chromium& browser, const std::string& section, int panels, int charts) {
        EXPECT_EQ(count(browser, "#" + section + " .panel"), panels) << section;
        EXPECT_EQ(count(browser, "#" + section + " svg.chart"), panels * charts) << section;
        EXPECT_EQ(count(browser, "#" + section + " svg.chart:not(:has([data-r]))"), 0) << section;
    }

    /// Pictures of each section into $STRANDLAB_SCREENSHOTS, for people to look at.
    static void keep_screenshots(Chromium& browser) {
        const char* folder = std::getenv("STRANDLAB_SCREENSHOTS");
        if (folder == nullptr) return;
        for (const bool dark : {false, true})
            for (const int width : {1600, 390})
                for (const Json& section :
                     browser.evaluate("[...document.querySelectorAll('section')].map(s => s.id)")) {
                    const std::string id = section.get<std::string>();
                    browser.use_dark(dark);
                    browser.resize(width, 1300);
                    browser.evaluate(
                        "document.documentElement.style.scrollBehavior = 'auto'; "
                        "document.getElementById('" +
                        id + "').scrollIntoView()");
                    browser.evaluate("new Promise(done => setTimeout(done, 150))");
                    write_file(
                        fmt::format("{}/default-{}-{}-{}.png", folder, id, width, dark ? "dark" : "light"),
                        browser.screenshot());
                }
    }
};

#if defined(STRANDLAB_D3) && defined(STRANDLAB_IMAGES)
TEST_F(DefaultSweepTest, ItsReportOpensAndWorks) {
    const std::string program = find_chromium();
    if (program.empty()) GTEST_SKIP() << "no Chromium (tools/setup installs it)";
    run_sweep();
    if (HasFatalFailure()) return;
    Chromium browser(program);
    browser.resize(1600, 1000);
    browser.open(path("report.html"));
    EXPECT_EQ(browser.messages(), std::vector<std::string>());

    // Seven hairstyles, primary and diffuse rays; pictures of the former.
    expect_charts(browser, "tradeoffs", 14, 4);
    expect_charts(browser, "memory", 7, 1);
    expect_charts(browser, "errors", 14, 5);
    EXPECT_EQ(count(browser, "#distances .panel"), 7);
    EXPECT_GE(count(browser, "#distances svg.chart"), 7 * 4);
    const int rows =
        browser.evaluate("JSON.parse(document.getElementById('found').textContent.match(/[0-9]+/)[0])");
    EXPECT_GE(rows, 7 * 2 * 4);

    // Sorting: by time, from the fastest.
    const std::string times =
        "(() => { const heads = [...document.querySelectorAll('#table thead th')], i = heads.findIndex(h => "
        "h.querySelector('button').firstChild.data === 'trace'); heads[i].querySelector('button').click(); "
        "return "
        "[...document.querySelectorAll('#table tbody tr')].map(r => "
        "Number(r.cells[i].textContent.replace(',', ''))); "
        "})()";
    const Json ascending = browser.evaluate(times);
    EXPECT_EQ(ascending.size(), static_cast<size_t>(rows));
    EXPECT_TRUE(std::is_sorted(ascending.begin(), ascending.end())) << ascending;

    // Comparison: all pictures of all cases load, and a primitive's differ from the reference's.
    const Json loaded = browser.evaluate(R"((async () => {
        const ready = (image) => image.decode().then(() => image.naturalWidth);
        const group = document.getElementById('picture-group'), sides = ['a', 'b'].map((s) => document.getElementById('picture-' + s));
        const shown = document.getElementById('image-a');
        const kinds = {};
        for (const scene of [...group.options]) {
            group.value = scene.value;
            group.dispatchEvent(new Event('change'));
            for (const picture of [...sides[0].options]) {
                sides[0].value = picture.value;
                sides[0].dispatchEvent(new Event('change'));
                if (await ready(shown) > 1) kinds[picture.text.split(' – ')[1]] = (kinds[picture.text.split(' – ')[1]] || 0) + 1;
            }
        }
        return kinds;
    })())");
    EXPECT_EQ(loaded, Json({{"rendered", 28}, {"reference", 28}, {"error map", 28}}));
    const Json differing = browser.evaluate(R"((async () => {
        const pixels = async (id) => {
            const image = document.getElementById(id);
            await image.decode();
            const canvas = document.createElement('canvas');
            canvas.width = image.naturalWidth, canvas.height = image.naturalHeight;
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            return context.getImageData(0, 0, canvas.width, canvas.height).data;
        };
        document.getElementById('picture-group').dispatchEvent(new Event('change'));
        const [a, b] = [await pixels('image-a'), await pixels('image-b')];
        return a.filter((value, i) => value !== b[i]).length / a.length;
    })())");
    EXPECT_GT(differing.get<double>(), 0.001);  // dots against the reference
    EXPECT_LT(differing.get<double>(), 0.9);
    const Json place = browser.show("#cut-at");
    browser.mouse("mousePressed", place[0].get<double>() / 2, place[1]);
    browser.mouse("mouseReleased", place[0].get<double>() / 2, place[1]);
    EXPECT_NE(browser.evaluate("getComputedStyle(document.getElementById('image-b')).clipPath"),
              "inset(0px 0px 0px 50%)");
    EXPECT_EQ(browser.messages(), std::vector<std::string>());
    keep_screenshots(browser);
}
#endif

}  // namespace
}  // namespace strandlab::testing_tools
