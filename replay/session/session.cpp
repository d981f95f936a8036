#include "replay/session/session.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/nearest_name.h"
#include "replay/gpu/device_memory.h"
#include "replay/gpu/host_timer.h"
#include "replay/measure/host_memory.h"
#include "replay/measure/measured_rounding.h"
#include "replay/plural.h"
#include "replay/scene/shrink_textures.h"
#include "replay/session/describe_run.h"
#include "replay/session/device_session.h"
#include "replay/session/light_unit.h"
#include "replay/session/session_on_device.h"

namespace strata {
namespace {

Result<std::size_t> find_step(const Plan& plan, std::string_view wanted) {
    std::vector<std::string_view> known;
    for (std::size_t i = plan.steps.size(); i-- > 0;) {
        known.push_back(plan.steps[i].step.name);
        if (known.back().find(wanted) != std::string_view::npos) return i;
    }
    return fail(Fault::usage, "session.no_step", "no step '{step}'{suggestion}", wanted, did_you_mean(wanted, known));
}

}  // namespace

DeviceSession::DeviceSession(std::unique_ptr<Device> device, Source source, std::uint64_t memory_budget)
    : DeviceSession(*device, std::move(source)) {
    own_device_ = std::move(device);
    memory_budget_ = memory_budget;
}

DeviceSession::DeviceSession(Device& device, Source source)
    : device_(&device),
      executor_(Executor::create(*device_)),
      scene_(*executor_),
      memo_(*executor_, memo_budget_bytes),
      source_(std::move(source)) {}

std::size_t DeviceSession::frame_count() const {
    if (const auto* capture = std::get_if<Capture>(&source_)) return capture->frame_count();
    return std::get<std::vector<Frame>>(source_).size();
}

Result<Frame> DeviceSession::frame(std::size_t index) {
    const std::size_t count = frame_count();
    if (index >= count)
        return fail(Fault::usage, "capture.no_frame", "there is no frame {frame}: the capture has {frames}, numbered from 0",
                    index, count);
    if (const auto* capture = std::get_if<Capture>(&source_)) return capture->frame(index);
    return std::get<std::vector<Frame>>(source_)[index];
}

Result<Run> DeviceSession::run(const Request& request) {
    if (request.passes == Passes::read_back) return run_with_passes(request);
    RunOptions options;
    auto declared = request.once ? prepare(request, nullptr, Keep::outputs) : prepare_with_memo(request, options);
    if (!declared) return declared.error();
    Declaration& d = *declared;
    if (!request.until.empty()) {
        const auto until = find_step(d.plan, request.until);
        if (!until) {
            memo_.drop_unfilled();
            return until.error();
        }
        options.until = *until;
    }
    const bool checks_light = request.light == LightCheck::on && memory_budget_ == 0;
    const std::vector<LightPeek> light = checks_light ? peek_at_light(d, options) : std::vector<LightPeek>();
    const auto execution = execute(d, options, Work::found);
    if (!execution) return execution.error();
    Run run = finished(d, *execution, options.until);
    for (const LightPeek& at : light) check_light(d, at.pass, at.image, execution->peeked[at.peek], run);
    if (options.until) memo_.drop_unfilled();
    else remember(d, *execution);
    return run;
}

Result<Run> DeviceSession::run_from(const Request& request, Stage stage, const ImageSet& outputs) {
    if (const auto loaded = load_variant(request.variant); !loaded) return loaded.error();
    const Sources sources{*loaded_, scene_, device(), shaders()};
    ImageSet scaled;
    const ImageSet& given = in_unit(pre_exposure(), outputs, scaled);
    const auto declared = failures_as_errors([&] { return declare_from(request, sources, stage, given); });
    if (!declared) return declared.error();
    Result<void> uploaded;
    for (const auto& [id, image] : declared->given) {
        const std::vector<glm::vec4> texels(image->texels.begin(), image->texels.end());
        if (uploaded) uploaded = upload(id, std::as_bytes(std::span(texels)));
    }
    const auto execution = uploaded ? execute(*declared, {}, Work::found) : Result<Execution>(uploaded.error());
    for (const auto& [id, image] : declared->given) executor_->forget(id);
    if (!execution) return execution.error();
    return finished(*declared, *execution);
}

Result<std::vector<Run>> DeviceSession::run(Frame made, std::span<const Request> requests) {
    std::vector<Run> runs;
    loaded_.reset();
    for (Request request : requests) {
        request.once = true;  // what the memo keeps belongs to the capture's frames
        auto loaded = !loaded_ || loaded_->variant != request.variant ? load(made, request.variant) : Result<void>();
        auto run = loaded ? this->run(request) : Result<Run>(loaded.error());
        if (!run) {
            loaded_.reset();
            return run.error();
        }
        runs.push_back(*std::move(run));
    }
    loaded_.reset();
    return runs;
}

Result<Session::PlannedFrame> DeviceSession::plan(const Request& request) {
    return prepare(request, nullptr, Keep::outputs).and_then([&](auto& declared) {
        return PlannedFrame{std::move(declared.plan), std::move(declared.frame.skipped), loaded_->features};
    });
}

Result<void> DeviceSession::check_going() const {
    if (stop_.stop_requested()) return fail(Fault::stopped, "session.stopped", "stopped");
    if (is_lost_)
        return fail(Fault::device_failed, "device.lost", "the device was lost and does nothing any more; open the capture again");
    return {};
}

Result<void> DeviceSession::load_variant(const FrameVariant& variant) {
    if (const auto on = check_going(); !on) return on;
    times_ = {};
    if (loaded_ && loaded_->variant == variant) return {};
    HostTimer timer;
    auto recorded = frame(variant.frame);
    if (!recorded) return recorded.error();
    if (auto loaded = load(*std::move(recorded), variant); !loaded) return loaded;
    times_.load = timer();
    return {};
}

Result<Declaration> DeviceSession::prepare(const Request& request, Memo* memo, Keep keep) {
    if (const auto loaded = load_variant(request.variant); !loaded) return loaded.error();
    HostTimer timer;
    auto declared = failures_as_errors([&] { return declare(request, {*loaded_, scene_, device(), shaders(), memo}, keep); });
    if (!declared) memo_.drop_unfilled();
    times_.declare = timer();
    return declared;
}

Result<void> DeviceSession::load(Frame frame, const FrameVariant& variant) {
    auto loaded = load_frame(std::move(frame), variant);
    if (!loaded) return loaded.error();
    loaded_ = *std::move(loaded);
    loaded_->notes = shrink_textures(loaded_->frame, device().max_buffer_bytes);
    not_uploaded_ = scene_records(loaded_->facts);
    scene_.describe(*not_uploaded_);
    return {};
}

Result<void> DeviceSession::check_sizes(const Plan& plan) const {
    for (const MemorySlot& slot : plan.slots) {
        const auto [width, height, depth] = slot.shape.extent;
        if (depth > 1 || std::max(width, height) <= device().max_image_extent) continue;
        return fail(Fault::device_lacks, "device.image_too_large",
                    "'{image}' is an image of {width} x {height} texels and {device} makes at most {limit} each way; replay with "
                    "a smaller extent or settings that take less",
                    plan.images[slot.images.front()].name, width, height, device().name, device().max_image_extent);
    }
    for (const PlannedStep& step : plan.steps)
        for (const PlannedBinding& bound : step.bindings) {
            if (bound.kind != BindingKind::storage_buffer) continue;
            const BufferRecord& buffer = plan.buffers[bound.binding.buffer.id];
            if (buffer.bytes <= device().max_buffer_bytes) continue;
            const std::string advice = buffer.import ? "it grows with what the frame draws: replay one that draws less"
                                                     : "replay with a smaller extent or settings that take less";
            return fail(Fault::device_lacks, "device.buffer_too_large",
                        "'{buffer}' takes {mebibytes} MiB and {device} binds at most {limit} MiB at once; {advice}", buffer.name,
                        buffer.bytes >> 20, device().name, device().max_buffer_bytes >> 20, advice);
        }
    return {};
}

template <typename Action>
std::invoke_result_t<Action> DeviceSession::failures_as_errors(Action action) {
    try {
        return action();
    } catch (const DeviceLost& failure) {
        is_lost_ = true;
        return fail(Fault::device_failed, failure.id(), "{reason}; open the capture again", failure.what());
    } catch (const MemoryLacks& failure) {
        return fail(Fault::device_lacks, failure.id(),
                    "{reason}; replay a smaller frame, with --samples 1 or with another technique", failure.what());
    } catch (const DeviceFailure& failure) {
        return fail(Fault::device_failed, failure.id(), "{reason}", failure.what());
    }
}

Result<BlendRounding> DeviceSession::rounding() {
    if (rounding_) return *rounding_;
    executor_->forget_plan();  // a memory budget need not have room for another
    return failures_as_errors([&]() -> Result<BlendRounding> { return rounding_.emplace(measured_rounding(*device_)); });
}

void DeviceSession::upload_scene() {
    if (!not_uploaded_) return;
    HostTimer timer;
    if (memory_budget_ != 0) {  // the old frame's memory goes first
        executor_->forget_plan();
        scene_.forget();
    }
    scene_.upload(*not_uploaded_);
    not_uploaded_.reset();
    times_.upload = timer();
}

void DeviceSession::make_remembered(const Plan& plan) {
    for (const BufferRecord& buffer : plan.buffers)
        if (buffer.remembered && !remembered_.contains(buffer.import->key)) {
            executor_->upload(*buffer.import, std::vector<std::byte>(buffer.bytes));
            remembered_.emplace(buffer.import->key, *buffer.remembered);
        }
}

Result<void> DeviceSession::upload(ImportId id, std::span<const std::byte> bytes) {
    return failures_as_errors([&]() -> Result<void> {
        executor_->upload(id, bytes);
        return {};
    });
}

void DeviceSession::forget_work() {
    std::erase_if(remembered_, [&](const auto& held) {
        if (held.second == Remembered::work) executor_->forget({held.first});
        return held.second == Remembered::work;
    });
}

void DeviceSession::limit_memo(std::uint64_t bytes) { memo_.limit(std::min(bytes, memo_budget_bytes)); }

void DeviceSession::forget_memo() {
    memo_.clear();
    remembered_.clear();
}

void DeviceSession::give_back_memory() {
    executor_->give_back_memory();
    release_freed_memory();
}

Result<Execution> DeviceSession::execute(const Declaration& d, RunOptions options, Work work) {
    if (work == Work::done) forget_work();
    options.stop = stop_;
    const bool uses_memo = !d.memo_writes.empty() || !d.scopes_from_memo.empty();
    auto execution = check_going()
                         .and_then([&] { return check_sizes(d.plan); })
                         .and_then([&] { return uses_memo ? Result<void>() : make_room(d.plan, options); })
                         .and_then([&] {
                             return failures_as_errors([&]() -> Result<Execution> {
                                 upload_scene();
                                 make_remembered(d.plan);
                                 return executor_->run(d.plan, options);
                             });
                         })
                         .and_then([&](auto& executed) {
                             times_.device = executed.host_ms;
                             return without_fatal_counts(d, std::move(executed));
                         });
    if (execution) return execution;
    memo_.drop_unfilled();
    if (stop_.stop_requested()) return check_going().error();
    remembered_.clear();  // the frame may have got halfway, or have left what is wrong
    return execution;
}

Run DeviceSession::finished(const Declaration& d, const Execution& execution, std::optional<std::size_t> until) {
    Run run = describe_run(d);
    run.counters = run_counters(d, execution, until);
    run.not_counted = not_counted(d, until);
    run.images = images_of(d, execution);
    for (auto& [name, image] : run.images) image = as_recorded(name, std::move(image));
    run.tables = tables_of(d, execution);
    for (auto& [name, table] : run.tables) scale_light(table, 1 / pre_exposure());
    run.notes = loaded_->notes;
    run.not_supported = not_supported(d, loaded_->features);
    for (const UnsupportedChoice& choice : run.not_supported)
        run.notes.push_back(fmt::format("{} cannot do {}: what it shows is wrong", choice.technique, choice.reason));
    std::ranges::copy(notes_of_techniques(d), std::back_inserter(run.notes));
    if (const std::size_t replaced = shader_sets_.empty() ? 0 : shader_sets_.back()->compiled.size())
        run.notes.push_back(fmt::format("{} replaced at run time", plural(replaced, "shader")));
    run.pipelines_created = execution.pipelines_created;
    run.host_ms = times_;
    const DeviceMemory memory = executor_->memory();
    run.memory.plan = memory.plan;
    run.memory.memo = memo_.held();
    run.memory.scene = memory.imports - std::min(memory.imports, run.memory.memo);
    run.memory.allocated = memory.allocated;
    run.memory.peak_allocated = memory.peak_allocated;
    run.memory.host_peak = host_peak_bytes();
    return run;
}

HostImage DeviceSession::as_recorded(std::string_view name, HostImage image) const {
    return scaled_light(name, std::move(image), 1 / pre_exposure());
}

void DeviceSession::remember(const Declaration& d, const Execution& execution) {
    for (const auto& [key, scope] : d.memo_writes) memo_.commit(key, read_counters(d, execution, scope));
}

namespace {

Result<std::unique_ptr<Session>> open_session(const DeviceChoice& choice, DeviceSession::Source source) {
    return Device::open(choice).and_then([&](auto& device) {
        return std::unique_ptr<Session>(
            std::make_unique<DeviceSession>(std::move(device), std::move(source), choice.memory_budget));
    });
}

}  // namespace

Result<std::unique_ptr<Session>> Session::open(const std::filesystem::path& path, const DeviceChoice& choice, Partial partial) {
    auto capture = Capture::open(path, partial, choice.memory_budget);
    if (!capture) return capture.error();
    if (capture->frame_count() == 0) return fail(Fault::bad_input, "capture.no_frames", "{file} holds no frame", path.string());
    return open_session(choice, *std::move(capture));
}

Result<std::unique_ptr<Session>> Session::open(std::vector<Frame> frames, const DeviceChoice& choice) {
    return open_session(choice, std::move(frames));
}

std::unique_ptr<Session> open_session_on(Device& device, std::vector<Frame> frames) {
    auto session = std::make_unique<DeviceSession>(device, std::move(frames));
    session->give_back_memory();  // what sessions before it left
    return session;
}

std::string Session::capture_id() const { return capture() ? capture()->id() : "made in code"; }

Result<std::vector<PassImages>> Session::pass_images(Request request) {
    request.outputs.clear();
    request.passes = Passes::read_back;
    return this->run(request).and_then([&](auto& run) { return std::move(run.passes); });
}

}  // namespace strata
