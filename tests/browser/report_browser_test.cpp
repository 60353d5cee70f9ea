#include "base/file.h"
#include "browser/chromium.h"
#include "report/html/figures.h"
#include "report/html/page.h"
#include "unit/support/result_rows.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <zlib.h>

namespace strandlab::testing_tools {
namespace {

std::string big_endian(uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xFF);
    return bytes;
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return big_endian(static_cast<uint32_t>(data.size())) + body + big_endian(static_cast<uint32_t>(crc));
}

/// A grey picture of 64 x 36 pixels.
std::string grey_png(int grey) {
    std::string rows;
    for (int y = 0; y < 36; ++y) rows += '\0' + std::string(64, static_cast<char>(grey));
    std::string packed(compressBound(rows.size()), '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
             rows.size());
    packed.resize(size);
    const std::string header = big_endian(64) + big_endian(36) + std::string("\x08\0\0\0\0", 5);
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}

/// One browser for all tests.
class ReportBrowserTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
#ifdef STRANDLAB_D3
        if (const std::string program = find_chromium(); !program.empty())
            browser_ = std::make_unique<Chromium>(program);
#endif
    }
    static void TearDownTestSuite() { browser_.reset(); }

    void SetUp() override {
        if (!browser_) GTEST_SKIP() << "no Chromium, or built without D3 (tools/setup installs both)";
        browser().resize(1600, 1000);
        browser().use_dark(false);
    }

    static Chromium& browser() { return *browser_; }

    /// Two scenes, of four primitives and with pictures each, a row of shadow rays, and stress cells.
    MergedResults results() const {
        MergedResults results;
        for (const char* scene : {"curly", "fur"})
            for (const auto& [primitive, ms, bytes, p99] : {std::tuple("dots", 9.0, 400.0, 0.4),
                                                            {"lss:segments=8", 5.0, 300.0, 0.06},
                                                            {"prhi", 7.0, 100.0, 0.001},
                                                            {"rocaps", 6.0, 120.0, 0.0004}}) {
                ResultRow row = result_row(primitive, ms, bytes, p99);
                row.model.name = scene;
                Json json = to_json(row);
                json["reproduce"] = std::string("strandlab bench ") + scene + " --primitive " + primitive;
                json["folder"] = folder_ / ".";
                json["images"] = {{"rendered", "a.png"}, {"error_map", "b.png"}};
                for (int scale = 1; scale <= 32; scale *= 2)
                    json["distances"].push_back({{"scale", scale},
                                                 {"coverage_bias", -0.1 * p99 / scale},
                                                 {"depth_bias", p99},
                                                 {"flip", p99 / scale}});
                for (const int bin : {3, 6, 7}) json["model_error"]["all"]["distance"]["decades"][bin] = 100;
                results.rows.push_back(std::move(json));
            }
        results.stress.push_back(Json{{"family", "grazing"},
                                      {"primitive", "lss"},
                                      {"device", "cpu-float"},
                                      {"decisive_hits", 10},
                                      {"decisive_misses", 10},
                                      {"nan_hits", 0},
                                      {"verdict", "holds"}});
        return results;
    }

    void open(const MergedResults& results) const {
        write_file(folder_ / "a.png", grey_png(90));
        write_file(folder_ / "b.png", grey_png(200));
        write_file(folder_ / "report.html", report_page(results, {}));
        browser().open(folder_ / "report.html");
    }

    /// Cells of a column of the table, from the top.
    static Json column(const std::string& heading) {
        return browser().evaluate(
            "(() => { const heads = [...document.querySelectorAll('#table thead th')]; const i = "
            "heads.findIndex("
            "h => h.querySelector('button').firstChild.data === '" +
            heading +
            "'); return [...document.querySelectorAll('#table tbody tr')].map(r => r.cells[i].textContent); "
            "})()");
    }
    static void click_heading(int place) {
        browser().click("#table thead th:nth-child(" + std::to_string(place) + ") button");
    }
    static int count(const std::string& selector) {
        return browser().evaluate("document.querySelectorAll('" + selector + "').length").get<int>();
    }

    TestFolder folder_;

  private:
    static std::unique_ptr<Chromium> browser_;
};
std::unique_ptr<Chromium> ReportBrowserTest::browser_;

TEST_F(ReportBrowserTest, OpensWithoutAWordOnTheConsole) {
    open(results());
    EXPECT_EQ(count("#tradeoffs .panel"), 2);
    EXPECT_EQ(count("#tradeoffs svg.chart"), 8);
    EXPECT_EQ(count("#memory svg.chart"), 2);
    EXPECT_EQ(count("#errors svg.chart"), 8);
    EXPECT_EQ(count("#stress svg.chart"), 1);
    EXPECT_EQ(count("#table tbody tr"), 8);
    EXPECT_EQ(count("nav a"), 9);
    EXPECT_EQ(browser().messages(), std::vector<std::string>());
    EXPECT_EQ(browser().requests().size(), 1u);  // the page itself
}

TEST_F(ReportBrowserTest, MarksAreSeen) {
    open(results());
    browser().show("#tradeoffs use[data-r]");
    const Json box = browser().evaluate(
        "(() => { const m = document.querySelector('#tradeoffs use[data-r]'); const b = "
        "m.getBoundingClientRect(); return [b.width, b.height, getComputedStyle(m).stroke]; })()");
    EXPECT_GT(box[0], 3);
    EXPECT_GT(box[1], 3);
    EXPECT_NE(box[2], "none");
}

TEST_F(ReportBrowserTest, PointingAtAMarkShowsItsRow) {
    open(results());
    const Json place = browser().show("#tradeoffs use[data-r=\"1\"]");
    browser().mouse("mouseMoved", place[0].get<double>() + 5, place[1]);
    EXPECT_EQ(browser().evaluate("document.getElementById('tip').hidden"), false);
    EXPECT_EQ(browser().evaluate("document.querySelector('#tip b').textContent"), "lss:segments=8");
    browser().mouse("mouseMoved", 2, 2);
    EXPECT_EQ(browser().evaluate("document.getElementById('tip').hidden"), true);
}

TEST_F(ReportBrowserTest, ArrowKeysWalkOverAChart) {
    open(results());
    browser().evaluate("document.querySelector('#errors .pair svg').focus()");
    browser().press_key("ArrowRight");
    const Json first = browser().evaluate("document.querySelector('#tip b').textContent");
    browser().press_key("ArrowRight");
    EXPECT_NE(browser().evaluate("document.querySelector('#tip b').textContent"), first);
    browser().evaluate(
        "dispatchEvent(new Event('scroll'))");  // as comes late after focus() on a slow machine
    EXPECT_EQ(browser().evaluate("document.getElementById('tip').hidden"), false);
    browser().press_key("Enter");
    EXPECT_EQ(browser().evaluate("document.getElementById('details').open"), true);
}

TEST_F(ReportBrowserTest, TheErrorMeasureCanBeChosen) {
    open(results());
    const std::string seen = "document.querySelector('#tradeoffs .by-wrong').offsetHeight > 0";
    EXPECT_EQ(browser().evaluate(seen), false);
    browser().click("label[for=by-wrong]");
    EXPECT_EQ(browser().evaluate(seen), true);
    EXPECT_EQ(browser().evaluate("document.querySelector('#tradeoffs .by-distance').offsetHeight"), 0);
}

TEST_F(ReportBrowserTest, FiltersChoosePanels) {
    open(results());
    EXPECT_EQ(count("#tradeoffs .panel:not([hidden])"), 2);
    browser().evaluate(
        "(() => { const s = document.querySelector('[data-filter=scene]'); s.value = 'fur'; "
        "s.dispatchEvent(new Event('change')); })()");
    EXPECT_EQ(count("#tradeoffs .panel:not([hidden])"), 1);
    EXPECT_EQ(browser().evaluate("document.querySelector('#tradeoffs .panel:not([hidden])').dataset.scene"),
              "fur");
}

TEST_F(ReportBrowserTest, HeadingsSort) {
    open(results());
    const Json headings = browser().evaluate(
        "[...document.querySelectorAll('#table thead th button')].map(b => b.firstChild.data)");
    int place = 1;
    for (const Json& heading : headings) {
        if (heading == "trace") break;
        ++place;
    }
    click_heading(place);
    EXPECT_EQ(column("trace"), Json({"5", "5", "6", "6", "7", "7", "9", "9"}));
    click_heading(place);
    EXPECT_EQ(column("trace"), Json({"9", "9", "7", "7", "6", "6", "5", "5"}));
    click_heading(1);
    EXPECT_EQ(column("scene"), Json({"curly", "fur", "curly", "fur", "curly", "fur", "curly", "fur"}));
    EXPECT_EQ(count("#table thead th[aria-sort=ascending]"), 1);
}

TEST_F(ReportBrowserTest, TheTableFinds) {
    open(results());
    const auto find = [&](const std::string& words) {
        browser().evaluate("(() => { const f = document.getElementById('find'); f.value = '" + words +
                           "'; f.dispatchEvent(new Event('input')); })()");
        return count("#table tbody tr");
    };
    EXPECT_EQ(find("LSS fur"), 1);
    EXPECT_EQ(find("nothing"), 0);
    EXPECT_EQ(find(""), 8);
    browser().click("#fronts");
    EXPECT_EQ(count("#table tbody tr"), 6);  // dots is on no front
}

TEST_F(ReportBrowserTest, ARowTellsItsCommand) {
    open(results());
    browser().click("#table tbody .row-link");
    EXPECT_EQ(browser().evaluate("document.getElementById('details').open"), true);
    EXPECT_EQ(browser().evaluate("document.querySelector('#details .command').textContent"),
              "strandlab bench curly --primitive dots");
    browser().click("#details .copy");
    EXPECT_EQ(browser().evaluate("new Promise(done => setTimeout(() => "
                                 "done(document.querySelector('#details .copy').textContent), 100))"),
              "Copied");
}

TEST_F(ReportBrowserTest, TwoPicturesAreCompared) {
    open(results());
    EXPECT_EQ(browser().evaluate("[...document.querySelectorAll('#layers img')].map(i => i.naturalWidth)"),
              Json({64, 64}));
    const std::string clip = "getComputedStyle(document.getElementById('image-b')).clipPath";
    const Json before = browser().evaluate(clip);
    browser().evaluate(
        "(() => { const c = document.getElementById('cut-at'); c.value = 20; c.dispatchEvent(new "
        "Event('input')); "
        "})()");
    EXPECT_NE(browser().evaluate(clip), before);
    EXPECT_EQ(browser().evaluate(clip), "inset(0px 0px 0px 20%)");
    const Json place = browser().show("#stage");
    browser().mouse("mouseWheel", place[0], place[1]);
    const std::string transform = "document.getElementById('layers').style.transform";
    EXPECT_NE(browser().evaluate("new Promise(done => setTimeout(() => done(" + transform + "), 200))"), "");
    EXPECT_GT(browser().evaluate("d3.zoomTransform(document.getElementById('stage')).k"), 1);
    // The cut stays where it is on the screen.
    EXPECT_EQ(browser().evaluate("document.getElementById('cut').getBoundingClientRect().x > 0"), true);
    browser().click("#picture-reset");
    EXPECT_EQ(browser().evaluate("d3.zoomTransform(document.getElementById('stage')).k"), 1);
    browser().evaluate(
        "(() => { const m = document.getElementById('picture-mode'); m.value = 'difference'; "
        "m.dispatchEvent(new Event('change')); })()");
    EXPECT_EQ(browser().evaluate("getComputedStyle(document.getElementById('image-b')).mixBlendMode"),
              "difference");
    EXPECT_EQ(browser().messages(), std::vector<std::string>());
}

TEST_F(ReportBrowserTest, HostileNamesAreText) {
    const std::string script =
        "</script><script>window.owned = 1</script><img src=x onerror=\"window.owned = 1\">";
    MergedResults hostile = results();
    for (Json& row : hostile.rows) {
        row["model"]["name"] = row["rays"]["name"] = row["primitive"]["label"] = script;
        row["device"]["name"] = row["context"]["cpu"] = row["reproduce"] = script;
        row["time"]["warning"] = script;
    }
    open(hostile);
    browser().click("#table tbody .row-link");
    EXPECT_EQ(browser().evaluate("document.querySelector('#details .command').textContent"), script);
    EXPECT_EQ(browser().evaluate("typeof window.owned"), "undefined");
    EXPECT_EQ(count("img[src=x]"), 0);
    EXPECT_EQ(browser().messages(), std::vector<std::string>());
}

TEST_F(ReportBrowserTest, ThePolicyForbidsTheNetworkAndForeignScripts) {
    open(results());
    EXPECT_EQ(browser().evaluate(
                  "new Promise(done => { document.addEventListener('securitypolicyviolation', e => "
                  "done(e.effectiveDirective)); fetch('https://example.invalid/').catch(() => 0); })"),
              "connect-src");
    EXPECT_EQ(
        browser().evaluate("(() => { const s = document.createElement('div'); s.innerHTML = '<img src=x "
                           "onerror=\"window.owned = 1\">'; document.body.append(s); return new Promise(d => "
                           "setTimeout(() => d(typeof window.owned), 200)); })()"),
        "undefined");
}

TEST_F(ReportBrowserTest, LongPagesAreUnpacked) {
    MergedResults many;
    for (int scene = 0; scene < 70; ++scene)
        for (int i = 1; i <= 8; ++i) {
            ResultRow row = result_row("lss:segments=" + std::to_string(i), i, 60 * i, 1.0 / (i * i));
            row.model.name = "scene " + std::to_string(scene);
            many.rows.push_back(to_json(row));
        }
    open(many);
    EXPECT_EQ(count(".packed"), 0);
    EXPECT_EQ(count("#tradeoffs .panel"), 70);
    EXPECT_EQ(count("#tradeoffs .panel:not([hidden])"), 1);  // a long page begins with one scene
    EXPECT_EQ(count("#table tbody tr"), 100);
    browser().click("#more");
    EXPECT_EQ(count("#table tbody tr"), 560);
    EXPECT_EQ(browser().messages(), std::vector<std::string>());
}

TEST_F(ReportBrowserTest, FitsWideAndNarrowScreensLightAndDark) {
    open(results());
    const char* keep = std::getenv("STRANDLAB_SCREENSHOTS");  // a folder
    std::vector<Json> grounds;
    for (const bool dark : {false, true})
        for (const int width : {1600, 390}) {
            browser().use_dark(dark);
            browser().resize(width, width > 1000 ? 1000 : 844);
            EXPECT_LE(browser().evaluate("document.documentElement.scrollWidth"), width);
            grounds.push_back(browser().evaluate("getComputedStyle(document.body).backgroundColor"));
            const std::string picture = browser().screenshot();
            EXPECT_TRUE(picture.starts_with("\x89PNG"));
            if (keep)
                write_file(fmt::format("{}/report-{}-{}.png", keep, width, dark ? "dark" : "light"), picture);
        }
    EXPECT_EQ(grounds[0], grounds[1]);
    EXPECT_NE(grounds[0], grounds[2]);
}

TEST_F(ReportBrowserTest, FiguresAreWellFormed) {
    open(results());
    write_figures(results(), folder_ / "figures");
    size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "figures")) {
        const std::string svg = read_file(entry.path().string());
        EXPECT_EQ(browser().evaluate("new DOMParser().parseFromString(" + Json(svg).dump() +
                                     ", 'image/svg+xml').querySelector('parsererror') === null"),
                  true)
            << entry.path();
        ++seen;
    }
    EXPECT_EQ(seen, 25u);
}

}  // namespace
}  // namespace strandlab::testing_tools
