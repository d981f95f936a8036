// A comparison as JUnit's XML, which every CI system reads.
#include "replay/difference/comparison.h"
#include "replay/markup_text.h"

namespace strata {
namespace {

std::string case_xml(const PassComparison& pass, const ImageComparison& image, const std::string& artifacts) {
    std::string xml = fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n", escaped(pass.label), escaped(image.image));
    if (image.verdict == Verdict::over)
        xml += fmt::format("      <failure type=\"over tolerance\" message=\"{}\"/>\n", escaped(image.reason));
    if (image.verdict == Verdict::not_compared) xml += fmt::format("      <skipped message=\"{}\"/>\n", escaped(image.reason));
    std::string out = image.verdict == Verdict::warning || image.verdict == Verdict::within ? image.reason + "\n" : "";
    if (image.flip) out += fmt::format("flip mean {:.6f}\n", image.flip->mean);
    if (!artifacts.empty()) out += artifacts + "\n";
    if (!out.empty()) xml += fmt::format("      <system-out>{}</system-out>\n", escaped(out));
    return xml + "    </testcase>\n";
}

std::string suite_xml(const Comparison& comparison, const FrameComparison& frame,
                      const std::map<std::string, std::string>& artifacts) {
    std::string cases;
    std::size_t tests = 0, failures = 0, skipped = 0;
    for (const PassComparison& pass : frame.passes)
        for (const ImageComparison& image : pass.images) {
            const auto files = artifacts.find(case_name(frame.frame, pass, image));
            cases += case_xml(pass, image, files == artifacts.end() ? "" : files->second);
            ++tests;
            failures += image.verdict == Verdict::over;
            skipped += image.verdict == Verdict::not_compared;
        }
    std::string xml = fmt::format("  <testsuite name=\"{} frame {}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
                                  escaped(comparison.a.name), frame.frame, tests, failures, skipped);
    xml += fmt::format("    <properties>\n      <property name=\"rerun\" value=\"{}\"/>\n", escaped(comparison.rerun));
    for (const auto& [name, value] : {std::pair{"device a", comparison.a.device}, {"device b", comparison.b.device}})
        if (!value.empty()) xml += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
    if (!frame.divergence.pass.empty())
        xml += fmt::format("      <property name=\"first difference\" value=\"{}\"/>\n",
                           escaped(frame.divergence.pass + ": " + frame.divergence.image + ": " + frame.divergence.step));
    return xml + "    </properties>\n" + cases + "  </testsuite>\n";
}

}  // namespace

std::string as_junit(const Comparison& comparison, const std::map<std::string, std::string>& artifacts) {
    std::string suites;
    for (const FrameComparison& frame : comparison.frames) suites += suite_xml(comparison, frame, artifacts);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"strata diff\">\n" + suites + "</testsuites>\n";
}

}  // namespace strata
