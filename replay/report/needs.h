// What a frame makes and how much of it is read: a row for each image and buffer, and one for each stage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "replay/session/product_uses.h"
#include "replay/tables/sheet.h"

namespace strata {

/// A product of a technique; or one that the frame leaves out, or a step of it.
struct NeedsRow {
    std::string stage, technique, product;
    std::uint64_t made = 0, read = 0, room = 0;  ///< bytes; `room`: that it has, clears aside
    std::optional<Spread> ms;                    ///< of the steps that write it
    std::string readers;                         ///< "lighting, transparency"
    std::string left_out;                        ///< why; then it has no numbers
};

/// All products of a stage's technique.
struct StageNeeds {
    std::string stage;
    std::uint64_t made = 0, read = 0;
    std::optional<Spread> ms;
    std::size_t products = 0, left_out = 0;
};

struct Needs {
    DeviceInfo device;
    std::string capture_name, capture_id, view;  ///< `view`: how the camera was moved
    std::size_t frame = 0;
    std::uint32_t width = 0, height = 0, samples = 1;
    std::vector<NeedsRow> rows;  ///< by stage in the order of the frame, largest unread first
    std::vector<StageNeeds> stages;
    std::string date = {};  ///< utc_date(); the caller's
};

/// Watches the frame once and times it without marks; no repeats: no times.
Result<Needs> measure_needs(Session&, const Request&, std::size_t repeats, const Progress& = {});

/// Share of what is made that nobody reads; nothing where nothing is made.
std::optional<double> unread_share(std::uint64_t made, std::uint64_t read);

Sheet sheet_of(const Needs&);
Sheet sheet_of_stages(const Needs&);
Page page_of(std::span<const Needs>);
std::string as_text(std::span<const Needs>);
std::string as_json(std::span<const Needs>);
std::string as_csv(std::span<const Needs>);

}  // namespace strata
