// Walks the encoded frame by the schema's own tables. flatbuffers' text generator is not used: it prints 6 and 12 decimals.
#include "capture_format/codec/frame_json.h"

#include <flatbuffers/minireflect.h>

#include "capture_format/codec/encode_frame.h"
#include "capture_format/schema/capture_generated.h"

namespace strata {
namespace {

class JsonWriter final : public flatbuffers::IterationVisitor {
public:
    std::string text;
    bool names_are_good = true;

    void StartSequence() override { ++depth_, text += "{"; }
    void EndSequence() override { close("}"); }
    void Field(std::size_t, std::size_t written, flatbuffers::ElementaryType, bool, const flatbuffers::TypeTable*,
               const char* name, const std::uint8_t* value) override {
        if (value == nullptr) return;
        if (written > 0) text += ",";
        line();
        text += fmt::format("\"{}\": ", name);
    }
    void StartVector() override { ++depth_, text += "["; }
    void EndVector() override { close("]"); }
    void Element(std::size_t index, flatbuffers::ElementaryType type, const flatbuffers::TypeTable*,
                 const std::uint8_t*) override {
        if (index > 0) text += ", ";
        if (type == flatbuffers::ET_SEQUENCE) line();
    }

    void Bool(bool value) override { text += value ? "true" : "false"; }
    void UChar(std::uint8_t value, const char* name) override { named(value, name); }
    void Int(std::int32_t value, const char* name) override { named(value, name); }
    void UInt(std::uint32_t value, const char* name) override { named(value, name); }
    void Long(std::int64_t value) override { text += fmt::format("{}", value); }
    void ULong(std::uint64_t value) override { text += fmt::format("{}", value); }
    // The fewest digits that read back as the same number; check_frame() let only finite ones through.
    void Float(float value) override { text += fmt::format("{}", value); }
    void Double(double value) override { text += fmt::format("{}", value); }
    void String(const flatbuffers::String* value) override {
        names_are_good = flatbuffers::EscapeString(value->c_str(), value->size(), &text, false, false) && names_are_good;
    }

private:
    template <typename Number>
    void named(Number value, const char* name) {
        text += name ? fmt::format("\"{}\"", name) : fmt::format("{}", value);
    }

    void line() { text.append("\n").append(2 * depth_, ' '); }

    /// Numbers stay on the line that they began.
    void close(std::string_view bracket) {
        --depth_;
        if (text.back() == '}' || bracket == "}") line();
        text += bracket;
    }

    std::size_t depth_ = 0;
};

}  // namespace

Result<std::string> frame_json(const Frame& frame) {
    BlobCollector blobs;
    const std::vector<std::byte> encoded = encode_frame(frame, blobs);
    JsonWriter writer;
    flatbuffers::IterateFlatBuffer(reinterpret_cast<const std::uint8_t*>(encoded.data()), schema::FrameTypeTable(), &writer);
    if (!writer.names_are_good)
        return fail(Fault::bad_input, "capture.frame.name_utf8", "a name in the frame is not UTF-8, which JSON cannot hold");
    return writer.text + "\n";
}

}  // namespace strata
