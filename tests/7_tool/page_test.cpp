// strata report -o page.html: what the file holds, and what it does in a browser.
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/images/image_io.h"
#include "replay/report/page/page.h"
#include "tests/7_tool/browser.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Writes a page of panes whose question the baseline does not answer.
void make_page() {
    ASSERT_EQ(strata("record interpenetrating_panes -o a.strata --size 64x36").code, 0);
    const Finished made = strata("report a.strata --defaults --repeats 2 --error 1% -o page.html");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.out, "");
}

json data_of(const std::string& text) {
    constexpr std::string_view open = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = text.find(open) + open.size();
    return json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}

std::string from_base64(std::string_view text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t held = 0, bits = 0;
    for (const char c : text) {
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos) break;
        held = held << 6 | std::uint32_t(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += char(held >> bits & 255u);
    }
    return bytes;
}

/// The picture of the truth, which the style has.
HostImage truth_of(const std::string& text) {
    constexpr std::string_view open = "--truth:url(data:image/png;base64,";
    const std::size_t begin = text.find(open) + open.size();
    std::ofstream(folder() / "truth.png", std::ios::binary)
        << from_base64(std::string_view(text).substr(begin, text.find(')', begin) - begin));
    return must(read_png(folder() / "truth.png"));
}

// IEC 61966-2-1; the frame has an exposure of 1, the white of its film is 1.7.
double shown(double light) {
    const double display = std::clamp(light * (1 + light / (1.7 * 1.7)) / (1 + light), 0., 1.);
    return display <= .0031308 ? 12.92 * display : 1.055 * std::pow(display, 1 / 2.4) - .055;
}

TEST(Page, HoldsTheAnswerThePicturesAndTheTableInOneFile) {
    make_page();
    const std::string text = file_text(page());
    EXPECT_LT(text.size(), 5'000'000u);
    EXPECT_THAT(text, Not(HasSubstr("{{")));
    EXPECT_FALSE(asks_a_network(text));
    const json data = data_of(text);
    const std::string chosen = data["rows"][std::size_t(data["selected"])]["name"];
    EXPECT_THAT(text, HasSubstr("<h1>Use " + chosen + ": "));
    EXPECT_THAT(text, HasSubstr("<code>strata replay a.strata --frames 0 --use transparency/" + chosen + "</code>"));
    for (const json& row : data["rows"]) {
        EXPECT_THAT(text, HasSubstr("</svg>" + std::string(row["name"]))) << "in the table";
        EXPECT_TRUE(row.contains("worst")) << row << " has no picture";
    }
}

/// The worst pixel of each row with its own fragments; the steps of a row that ran once make up its time.
TEST(Page, ShowsWhereARowIsWorstAndWhatItsStepsTake) {
    ASSERT_EQ(strata("record interpenetrating_panes -o a.strata --size 64x36").code, 0);
    ASSERT_EQ(strata("report a.strata --techniques weighted,alpha_blend --repeats 1 -o page.html").code, 0);
    const std::string text = file_text(page());
    const json data = data_of(text);
    constexpr std::string_view open = "src=\"data:image/svg+xml;base64,";
    std::size_t at = 0;
    for (const json& row : data["rows"]) {
        at = text.find(open, at) + open.size();
        const std::string svg = from_base64(std::string_view(text).substr(at, text.find('"', at) - at));
        EXPECT_THAT(svg, HasSubstr(fmt::format("pixel ({}, {})", row["worst"][0].get<int>(), row["worst"][1].get<int>())));
        EXPECT_THAT(svg, HasSubstr(">" + row["name"].get<std::string>() + "<"));
    }
    const json report = json::parse(strata("report a.strata --techniques weighted,alpha_blend --repeats 1 --json").out);
    for (const json& row : report["rows"]) {
        double sum = 0;
        for (const json& step : row["steps"]) sum += step["ms"].get<double>();
        EXPECT_NEAR(sum, row["stage_ms"]["median"].get<double>(), 1e-6 * sum) << row["technique"];
    }
    EXPECT_GE(report["rows"][1]["steps"].size(), 2u);
    if (!Browser::is_there()) return;
    Browser browser(page());
    browser.value("document.querySelector('.rows tbody tr:last-child').click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('#steps tbody tr').length >= 2"));
    browser.value("document.querySelector('#probe summary').click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('#probe img').naturalWidth > 0"));
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
}

TEST(Page, ShowsTheTruthsRadianceAsADisplayDoes) {
    make_page();
    const HostImage truth = truth_of(file_text(page()));
    ASSERT_EQ(strata("replay a.strata --use transparency/sorted_lists --outputs color -o exact").code, 0);
    const NamedImages images = must(read_exr(only_file(folder() / "exact", ".exr")));
    const HostImage& color = images.at("color");
    double worst = 0, brightest = 0;
    for (std::uint32_t y = 0; y < 36; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(texel(truth, x, y)[c] - shown(texel(color, x, y)[c])));
                brightest = std::max(brightest, texel(truth, x, y)[c]);
            }
    EXPECT_LT(worst, .6 / 255);
    EXPECT_GT(brightest, .3);
}

/// Later stages read buffers of culling, which its truth does not have.
TEST(Page, OfAStageWhoseTruthCannotBeShownHasNoPictures) {
    ASSERT_EQ(strata("record city_of_boxes -o a.strata --size 32x18").code, 0);
    const Finished made = strata("report a.strata --stage culling --defaults --repeats 1 -o page.html");
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string text = file_text(page());
    EXPECT_THAT(text, HasSubstr("<p>no pictures: later stages read more"));
    EXPECT_THAT(text, Not(HasSubstr("data:image/png")));
    if (!Browser::is_there()) return;
    EXPECT_THAT(Browser(page()).complaints(), testing::IsEmpty());
}

/// Rows by frames on top, with the numbers of the JSON; a page for each frame below.
TEST(Page, OfSeveralFramesHasWhatEachRowIsOffOnEach) {
    ASSERT_EQ(strata("record glass_and_smoke -o a.strata --size 48x27 --frames 2").code, 0);
    const std::string measure = "report a.strata --frames 0-1 --techniques weighted,alpha_blend,k_buffer --repeats 2 --error 9%";
    ASSERT_EQ(strata(measure + " -o page.html").code, 0);
    const std::string text = file_text(page());
    EXPECT_LT(text.size(), 5'000'000u);
    EXPECT_THAT(text, Not(HasSubstr("{{")));
    EXPECT_FALSE(asks_a_network(text));
    EXPECT_THAT(text, HasSubstr("<h1>Keep alpha_blend over 2 frames: "));
    EXPECT_THAT(text, HasSubstr("<dt>k_buffer</dt><dd>"));
    const json reports = json::parse(strata(measure + " --json").out)["reports"];
    ASSERT_EQ(reports.size(), 2u);
    if (!Browser::is_there()) return;
    Browser browser(page());
    const auto is = [&](const std::string& expression) { return browser.becomes_true(expression); };
    for (std::size_t frame = 0; frame < reports.size(); ++frame) {
        const json& row = reports[frame]["rows"][1];
        ASSERT_EQ(row["technique"], "transparency/weighted");
        const std::string cell = fmt::format(".matrix a[data-frame=\"{}\"][data-row=\"1\"]", frame);
        const double shown = std::stod(browser.value("document.querySelector('" + cell + "').textContent").get<std::string>());
        EXPECT_NEAR(shown / 100, row["ranking_error"].get<double>(), 1e-3 * shown / 100);
        // A cell opens its row on its frame, whose page is as high as it needs and as dark as this one.
        browser.value("document.querySelector('" + cell + "').click()");
        const std::string frame_page = fmt::format("document.querySelectorAll('.frame iframe')[{}]", frame);
        EXPECT_TRUE(is(frame_page + ".contentDocument.querySelector('#name').textContent === 'weighted'"));
        EXPECT_TRUE(is(fmt::format("document.querySelectorAll('.frame')[{}].open", frame)));
        EXPECT_TRUE(is(fmt::format("{0}.clientHeight >= {0}.contentDocument.body.offsetHeight", frame_page)));
        EXPECT_TRUE(
            is("[..." + frame_page + ".contentDocument.querySelectorAll('.three img')].some(image => image.naturalWidth > 0)"));
    }
    browser.press('t');
    EXPECT_TRUE(
        is("[...document.querySelectorAll('.frame iframe')].every(frame => frame.contentDocument.documentElement.dataset.theme "
           "=== document.documentElement.dataset.theme)"));
    browser.value("document.querySelectorAll('.frame').forEach(frame => frame.open = false)");
    browser.press('p'), browser.press('p');
    EXPECT_TRUE(is("document.querySelectorAll('.frame')[0].open"));
    browser.press('n');
    EXPECT_TRUE(is("document.querySelectorAll('.frame')[1].open"));
    browser.press('?');
    EXPECT_TRUE(is("document.querySelector('#keys').open"));
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
}

/// A file that stands alone: its own colors and ground, a point for each row.
TEST(Page, ItsPlotIsAFile) {
    ASSERT_EQ(strata("record interpenetrating_panes -o a.strata --size 32x18 --frames 2").code, 0);
    for (const char* frames : {"0", "0-1"}) {
        const std::string measure =
            fmt::format("report a.strata --frames {} --techniques weighted,alpha_blend --repeats 1", frames);
        ASSERT_EQ(strata(measure + " -o plot.svg").code, 0);
        const std::string svg = file_text(folder() / "plot.svg");
        EXPECT_THAT(svg, testing::StartsWith("<svg "));
        EXPECT_THAT(svg, AllOf(HasSubstr("--bg: #fdfdfc"), HasSubstr("class=\"paper\""), HasSubstr(">transparency of ")));
        std::size_t points = 0;
        for (std::size_t at = svg.find("class=\"pt "); at != std::string::npos; at = svg.find("class=\"pt ", at + 1)) ++points;
        EXPECT_EQ(points, 2u);
    }
    EXPECT_THAT(strata("report --hard-cases -o plot.svg -v"), Refuses(2, "output.unknown_ending"));
}

/// 40 settings on 4 frames, each with more pictures than a page has room for.
TEST(Page, OfManyRowsOnSeveralFramesIsNoLargerThanOneMaySend) {
    std::vector<Report> reports(
        4, {.capture_name = "a.strata", .width = 640, .height = 360, .time_unit = "transparency/alpha_blend"});
    for (std::size_t frame = 0; frame < reports.size(); ++frame) {
        reports[frame].frame = frame;
        reports[frame].truths.emplace_back();
        reports[frame].truth_picture.resize(200'000);
        for (int i = 0; i < 40; ++i) {
            const std::vector<Metric> errors{{display_rmse, "of white", .001 * (1 + i)}};
            Measurement row{.technique = "transparency/weighted", .settings = fmt::format("scale={}", 1 + .01 * i)};
            row.accuracy = {.technique_errors = errors, .flip = .1, .touched = errors, .footing = Footing{.pixels = 5000}};
            row.stage_ms = row.frame_ms = {.median = 1. + i, .repeats = 3};
            row.time = Spread{.median = 1. + i, .low = .9 + i, .high = 1.1 + i, .repeats = 3};
            row.bytes_per_pixel = 1. + i;
            row.picture = RowPicture{.png = std::vector<std::byte>(100'000),
                                     .flip_png = std::vector<std::byte>(100'000),
                                     .probe_svg = std::string(40'000, ' ')};
            reports[frame].rows.push_back(row);
        }
    }
    const std::string text = as_html(reports, pooled(reports));
    EXPECT_LT(text.size(), 5'000'000u);
    EXPECT_GT(text.size(), 3'000'000u) << "what room there is has pictures";
    EXPECT_THAT(text, HasSubstr("no picture: the page would be too large"));
}

/// Rows and cases as they are measured; a failure has the color of its size.
TEST(Page, OfHardCasesIsTheirMatrix) {
    const std::size_t cases = hard_cases().size();
    HardCaseReport made{.rows = {{.technique = "transparency/weighted", .outcomes = std::vector<HardOutcome>(cases)},
                                 {.technique = "transparency/moments", .outcomes = std::vector<HardOutcome>(cases)}}};
    made.rows[0].outcomes[2] = {.verdict = HardOutcome::Verdict::documented, .error = .03, .reason = "adds <both>"};
    EXPECT_THAT(as_html(made), AllOf(HasSubstr("1 of 2 rows hold every one of "), HasSubstr("every failure is as documented"),
                                     HasSubstr("<td title=\"adds &lt;both&gt;\"><i class=\"k3\"></i>0.03</td>")));
    made.rows[1].outcomes[0] = {.verdict = HardOutcome::Verdict::undocumented, .error = .2};
    const std::string text = as_html(made);
    EXPECT_THAT(text, AllOf(HasSubstr("0 of 2 rows hold"), HasSubstr("in 1 row a failure is not as documented"),
                            HasSubstr("<i class=\"k5\"></i>0.2!</td>"), Not(HasSubstr("{{"))));
    EXPECT_FALSE(asks_a_network(text));
    std::ofstream(page(), std::ios::binary) << text;
    if (!Browser::is_there()) return;
    Browser browser(page());
    EXPECT_EQ(browser.value("document.querySelectorAll('.rows tbody td').length").get<std::size_t>(), 2 * (cases + 1));
    browser.press('t');
    EXPECT_TRUE(browser.becomes_true("['dark', 'light'].includes(document.documentElement.dataset.theme)"));
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
}

TEST(Page, IsOfReportsAlone) {
    ASSERT_EQ(strata("record three_panes -o a.strata --size 16x9").code, 0);
    EXPECT_THAT(strata("report a.strata --json -o page.html -v"), Refuses(2, "output.ending_contradicts"));
    EXPECT_FALSE(std::filesystem::exists(page()));
}

TEST(Page, DoesInABrowserWhatItsControlsSay) {
    if (!Browser::is_there()) GTEST_SKIP() << "no chromium-headless-shell";
    make_page();
    Browser browser(page());
    const auto is = [&](const std::string& expression) { return browser.becomes_true(expression); };
    EXPECT_TRUE(
        is("document.querySelector('#name').textContent === document.querySelector('h1').textContent.match(/^Use (.*): /)[1]"));
    EXPECT_TRUE(is("document.querySelectorAll('.three .pic').length === 3 && !document.querySelector('.three figure').hidden"));
    EXPECT_TRUE(is("document.querySelectorAll('.sheet canvas').length === document.querySelectorAll('.sheet .pic img').length"));
    // The magnifier is at the pixel that is furthest off; that of the least accurate row is.
    browser.value("document.querySelector('.rows tbody tr:last-child').click()");
    EXPECT_TRUE(
        is("/^[0-9.]+ % of white: [a-z ]+$/.test(document.querySelector('#off').textContent) && "
           "parseFloat(document.querySelector('#off').textContent) > 1"));

    browser.press('j');
    EXPECT_TRUE(
        is("document.querySelectorAll('.rows .chosen').length === 1 && document.querySelector('.rows "
           ".chosen').textContent.includes(document.querySelector('#name').textContent)"));
    EXPECT_TRUE(is("location.hash === '#' + encodeURIComponent(document.querySelector('#name').textContent)"));
    browser.press('r');
    EXPECT_TRUE(
        is("document.querySelector('#name').textContent === document.querySelector('h1').textContent.match(/^Use (.*): /)[1]"));
    const std::pair<char, const char*> modes[] = {{'1', "divider"},    {'2', "truth"},  {'3', "row"},
                                                  {'4', "difference"}, {'5', "signed"}, {'6', "flip"}};
    for (const auto& [key, mode] : modes) {
        browser.press(key);
        EXPECT_TRUE(is(std::string("document.querySelector('#modes [aria-pressed=true]').dataset.mode === '") + mode + "'"))
            << key;
    }
    EXPECT_TRUE(
        is("document.querySelector('.tag.left').textContent === 'FLIP against the truth' && "
           "!document.querySelector('#flips').hidden"));
    // The brighter, the larger; the last row is that of the largest error. Most of the picture is the truth's.
    browser.value("document.querySelector('.rows tbody tr:last-child').click()");
    EXPECT_TRUE(
        is("document.querySelector('.rows .chosen') === document.querySelector('.rows tbody tr:last-child') && "
           "!document.querySelector('#flips').hidden"));
    const json lit = browser.value(
        "(() => { const c = document.querySelector('#left'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; "
        "let n = "
        "0; for (let i = 0; i < d.length; i += 4) n += d[i] + d[i + 1] + d[i + 2] > 60; return n / (c.width * c.height); })()");
    EXPECT_GT(lit, 0);
    EXPECT_LT(lit, .6);
    browser.press('f');
    EXPECT_TRUE(is("document.querySelector('.tag.left').textContent === 'truth'"));
    browser.press('1'), browser.press('[');
    EXPECT_TRUE(is("document.querySelector('#divider').getAttribute('aria-valuenow') === '45'"));
    browser.press('m');
    EXPECT_TRUE(
        is("document.querySelector('#photos').getAttribute('aria-pressed') === 'true' && document.querySelector('.sheet "
           "canvas').hidden"));
    browser.press('t');
    EXPECT_TRUE(is("['dark', 'light'].includes(document.documentElement.dataset.theme)"));
    browser.press('?');
    EXPECT_TRUE(is("document.querySelector('#keys').open"));

    // Every pair of axes has its plot, and one is shown.
    EXPECT_GE(browser.value("document.querySelectorAll('#plots .one').length").get<int>(), 10);
    browser.value(
        "(() => { const up = document.querySelector('#up'); up.selectedIndex = 1; up.dispatchEvent(new Event('change')); })()");
    EXPECT_TRUE(
        is("document.querySelectorAll('#plots .one:not([hidden])').length === 1 && "
           "document.querySelector('#plots .one:not([hidden])').dataset.up === document.querySelector('#up').value"));
    // A click on a point chooses its row.
    browser.value("document.querySelector('#plots').scrollIntoView()");
    const json at = browser.value(
        "(() => { const b = document.querySelector('#plots .one:not([hidden]) .pt').getBoundingClientRect(); return [b.x + "
        "b.width / 2, b.y + b.height / 2]; })()");
    browser.click(at[0], at[1]);
    EXPECT_TRUE(is("document.querySelectorAll('#plots .one:not([hidden]) .pt.chosen').length === 1"));
    // Sorting by the last column orders its numbers; filters hide rows, points and pictures alike.
    browser.value("document.querySelector('.rows th:last-child button').click()");
    EXPECT_TRUE(
        is("(() => { const v = [...document.querySelectorAll('.rows tbody td:last-child')].map(cell => +cell.dataset.v); return "
           "v.every((x, i) => i === 0 || v[i - 1] <= x); })()"));
    browser.value(
        "(() => { const filter = document.querySelector('#filter'); filter.value = 'weighted'; filter.dispatchEvent(new "
        "Event('input')); })()");
    EXPECT_TRUE(
        is("[...document.querySelectorAll('.rows tbody tr:not([hidden])')].every(row => row.textContent.includes('weighted')) && "
           "document.querySelectorAll('.rows tbody tr:not([hidden])').length === 2 && document.querySelectorAll('.sheet "
           "figure:not([hidden])').length === 2"));
    browser.value(
        "(() => { const filter = document.querySelector('#filter'); filter.value = ''; filter.dispatchEvent(new Event('input')); "
        "document.querySelector('#front').click(); })()");
    EXPECT_TRUE(is(
        "document.querySelectorAll('.rows tbody tr:not([hidden])').length < document.querySelectorAll('.rows tbody tr').length"));
    browser.value("document.querySelector('#front').click(), document.querySelector('.technique').click()");
    EXPECT_TRUE(is("document.querySelectorAll('.rows tbody tr[hidden]').length === 1"));
    browser.value("document.querySelector('.cmd .copy').click()");
    EXPECT_TRUE(is("/copied|selected/.test(document.querySelector('.cmd .copy').textContent)"));
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
}

}  // namespace
}  // namespace strata
