#include "replay/session.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <set>

#include "capture_format/nearest_name.h"
#include "replay/counted.h"
#include "replay/declaration.h"
#include "replay/gpu/executor.h"
#include "replay/judgement.h"
#include "replay/scene/fit_textures.h"

namespace strata {
namespace {

// Kept stage outputs: a 1080p frame at four samples is about 1 GiB of them.
constexpr std::uint64_t memo_budget_bytes = std::uint64_t(1) << 30;

std::vector<CounterRecord> read_counters(const Declaration& d, const Execution& execution) {
    std::vector<CounterRecord> records;
    for (const CounterSource& source : d.counters) {
        const auto bytes = execution.buffers.find(source.buffer.id);
        for (const Counter& counter : source.technique->counters) {
            std::uint32_t value = 0;
            if (bytes != execution.buffers.end()) std::memcpy(&value, bytes->second.data() + counter.offset, sizeof value);
            const auto same = [&](const CounterRecord& r) {
                return r.technique == source.technique->name && r.name == counter.name;
            };
            const auto known = std::ranges::find_if(records, same);
            if (known == records.end())
                records.push_back({std::string(source.technique->name), std::string(counter.name), value});
            else known->value += value;  // a technique that acts at several stages counts in each
        }
    }
    return records;
}

/// Bytes of the images and buffers that a stage's steps are the first to touch, whether or not their memory is shared.
std::map<std::string, std::uint64_t> bytes_by_stage(const Plan& plan) {
    std::map<std::string, std::uint64_t> by_stage;
    std::vector<bool> image_seen(plan.images.size()), buffer_seen(plan.buffers.size());
    for (const PlannedStep& planned : plan.steps) {
        std::uint64_t& sum = by_stage[std::string(name(static_cast<Stage>(plan.scopes[planned.step.scope].stage)))];
        for (const Barrier& barrier : planned.barriers) {
            if (barrier.image && !image_seen[barrier.image.id]) {
                image_seen[barrier.image.id] = true;
                if (!plan.images[barrier.image.id].import) sum += bytes(plan.images[barrier.image.id].shape);
            }
            if (barrier.buffer && !buffer_seen[barrier.buffer.id]) {
                buffer_seen[barrier.buffer.id] = true;
                if (!plan.buffers[barrier.buffer.id].import) sum += plan.buffers[barrier.buffer.id].bytes;
            }
        }
    }
    return by_stage;
}

std::string choice_line(const Choice& choice) {
    std::string line(choice.technique->name);
    for (const std::string& setting : choice.settings.lines()) line += " " + setting;
    return line;
}

Run describe_run(const Declaration& d) {
    Run run{.skipped = d.frame.skipped,
            .culled = d.plan.culled,
            .image_bytes = d.plan.image_bytes,
            .buffer_bytes = d.plan.buffer_bytes};
    for (const PlannedStep& step : d.plan.steps) run.steps.push_back({d.plan.scopes[step.step.scope].name, step.step.name, {}});
    for (const DeclaredAct& act : d.frame.acts)
        run.choices[std::string(name(act.technique->stage))] = choice_line(d.choices.at(act.technique->stage));
    run.stage_bytes = bytes_by_stage(d.plan);
    run.acts_from_memo = d.scopes_from_memo.size();
    run.acts_executed = d.frame.acts.size() - run.acts_from_memo;
    return run;
}

/// The last step up to `end` that writes the image, or nothing.
std::optional<std::size_t> last_write(const Plan& plan, Image image, std::size_t end) {
    for (std::size_t i = std::min(end, plan.steps.size()); i-- > 0;)
        for (const Barrier& barrier : plan.steps[i].barriers)
            if (barrier.image.id == image.id && barrier.image && writes(barrier.after)) return i;
    return {};
}

/// Scopes are in the order of the steps.
std::size_t first_step_after(const Plan& plan, std::uint32_t scope) {
    const auto at = std::ranges::find_if(plan.steps, [&](const PlannedStep& s) { return s.step.scope > scope; });
    return static_cast<std::size_t>(at - plan.steps.begin());
}

class DeviceSession final : public Session {
public:
    /// Where frames come from: a file, or memory.
    using Source = std::variant<Capture, std::vector<Frame>>;

    DeviceSession(std::unique_ptr<Device> device, Source source)
        : device_(std::move(device)),
          executor_(Executor::create(*device_)),
          scene_(*executor_),
          memo_(*executor_, memo_budget_bytes),
          source_(std::move(source)) {}

    const DeviceInfo& device() const override { return device_->info(); }
    std::string capture_id() const override {
        const auto* capture = std::get_if<Capture>(&source_);
        return capture ? capture->id() : "made in code";
    }
    std::size_t frame_count() const override {
        if (const auto* capture = std::get_if<Capture>(&source_)) return capture->frame_count();
        return std::get<std::vector<Frame>>(source_).size();
    }
    Result<Frame> frame(std::size_t index) override {
        const std::size_t count = frame_count();
        if (index >= count)
            return fail(Fault::usage, "the capture has {}, counted from 0; there is no frame {}", counted(count, "frame"), index);
        if (const auto* capture = std::get_if<Capture>(&source_)) return capture->frame(index);
        return std::get<std::vector<Frame>>(source_)[index];
    }
    void forget_memo() override { memo_.clear(); }

    Result<Run> run(const Request& request) override {
        auto declared = prepare(request, &memo_, Keep::outputs);
        if (!declared) return declared.error();
        Declaration& d = *declared;
        RunOptions options;
        if (!request.until.empty()) {
            const auto until = find_step(d.plan, request.until);
            if (!until) return until.error();
            options.until = *until;
        }
        const std::size_t pipelines = executor_->pipelines_created();
        const auto execution = execute(d, options);
        if (!execution) {
            memo_.drop_unfilled();
            return execution.error();
        }
        Run run = describe_run(d);
        run.counters = read_counters(d, *execution);
        if (options.until) memo_.drop_unfilled();
        else remember(d, run.counters);
        run.counters.insert(run.counters.end(), d.kept_counters.begin(), d.kept_counters.end());
        collect_images(d, *execution, run);
        run.pipelines_created = executor_->pipelines_created() - pipelines;
        run.notes = loaded_->notes;
        return run;
    }

    Result<std::vector<Run>> time(std::span<const Request> requests, std::size_t repeats) override {
        std::vector<Run> runs;
        std::vector<std::vector<std::vector<double>>> step_ms(requests.size());  // [request][repeat][step]
        for (std::size_t repeat = 0; repeat <= repeats; ++repeat) {              // the first of each warms up
            for (std::size_t i = 0; i < requests.size(); ++i) {
                const auto declared = prepare(requests[i], nullptr, Keep::outputs);
                if (!declared) return declared.error();
                const auto execution = execute(*declared, {.timestamps = Timestamps::on});
                if (!execution) return execution.error();
                if (repeat > 0) {
                    step_ms[i].push_back(execution->step_ms);
                    continue;
                }
                runs.push_back(describe_run(*declared));
                runs.back().counters = read_counters(*declared, *execution);
                runs.back().notes = loaded_->notes;
                collect_images(*declared, *execution, runs.back());
            }
        }
        for (std::size_t i = 0; i < runs.size(); ++i) add_times(runs[i], step_ms[i]);
        return runs;
    }

    Result<PlannedFrame> plan(const Request& request) override {
        auto declared = prepare(request, nullptr, Keep::outputs);
        if (!declared) return declared.error();
        return PlannedFrame{std::move(declared->plan), std::move(declared->frame.skipped)};
    }

    Result<HostImage> peek(const Request& request, std::size_t step, const std::string& image) override {
        const auto declared = prepare(request, nullptr, Keep::outputs);
        if (!declared) return declared.error();
        const Plan& plan = declared->plan;
        if (step >= plan.steps.size())
            return fail(Fault::usage, "the plan has {} steps; there is no step {}", plan.steps.size(), step);
        const Image handle = declared->graph.find_image(image);
        if (!handle) return fail(Fault::usage, "the frame has no image '{}'", image);
        if (!last_write(plan, handle, step + 1)) return fail(Fault::usage, "'{}' is not written yet after step {}", image, step);
        auto execution = execute(*declared, {.until = step, .peeks = {{step, handle}}});
        if (!execution) return execution.error();
        return std::move(execution->peeked.front());
    }

    Result<std::vector<ActImages>> act_images(const Request&) override;
    Result<std::vector<StepImages>> step_images(const Request&, Stage) override;
    Result<ImageSet> truth(const Request&, Stage) override;
    Result<Accuracy> judge(const Request&, Stage, Against, const ImageSet* truth) override;

private:
    /// Every image as a stage's technique (its last act) found it, and the stage's outputs as it left them.
    struct Inspected {
        Choice choice;
        ImageSet before, result;
    };
    Result<Inspected> inspect(const Request&, Stage);

    /// Loads the frame's variant when it is not the current one, and declares the request on it.
    Result<Declaration> prepare(const Request& request, Memo* memo, Keep keep) {
        const FrameVariant variant = variant_of(request);
        if (!loaded_ || loaded_->variant != variant) {
            auto recorded = frame(request.frame);
            if (!recorded) return recorded.error();
            auto loaded = load_frame(*std::move(recorded), variant);
            if (!loaded) return loaded.error();
            loaded_ = std::make_unique<LoadedFrame>(*std::move(loaded));
            loaded_->notes = fit_textures(loaded_->frame, device().max_buffer_bytes);
            scene_.upload(scene_records(loaded_->frame));
        }
        return declare(request, {*loaded_, scene_, device(), memo}, keep);
    }

    /// Whether the device can bind every buffer whole.
    Result<void> check_buffers(const Plan& plan) const {
        for (const BufferRecord& buffer : plan.buffers)
            if (buffer.bytes > device().max_buffer_bytes)
                return fail(Fault::device_lacks,
                            "'{}' takes {} MiB and {} binds at most {} MiB at once; replay with a smaller extent or settings "
                            "that take less",
                            buffer.name, buffer.bytes >> 20, device().name, device().max_buffer_bytes >> 20);
        return {};
    }

    /// The one place where a device's collapse becomes an Error.
    Result<Execution> execute(const Declaration& d, const RunOptions& options) {
        if (const auto fits = check_buffers(d.plan); !fits) return fits.error();
        try {
            return executor_->run(d.plan, options);
        } catch (const DeviceFailure& failure) {
            return fail(Fault::device_failed, "{}", failure.what());
        }
    }

    static Result<std::size_t> find_step(const Plan& plan, std::string_view wanted) {
        std::vector<std::string_view> known;
        for (std::size_t i = plan.steps.size(); i-- > 0;) {
            known.push_back(plan.steps[i].step.name);
            if (known.back().find(wanted) != std::string_view::npos) return i;
        }
        return fail(Fault::usage, "no step '{}'{}", wanted, did_you_mean(wanted, known));
    }

    static void collect_images(const Declaration& d, const Execution& execution, Run& run) {
        for (const auto& [name, image] : d.outputs)
            if (const auto found = execution.images.find(image.id); found != execution.images.end())
                run.images[name] = found->second;
    }

    static void add_times(Run& run, const std::vector<std::vector<double>>& repeats) {
        const auto spread = [&](const std::function<bool(std::size_t)>& counts) {
            std::vector<double> sums;
            for (const std::vector<double>& steps : repeats) {
                sums.push_back(0);
                for (std::size_t i = 0; i < steps.size(); ++i)
                    if (counts(i)) sums.back() += steps[i];
            }
            return spread_of(sums);
        };
        run.frame_ms = spread([](std::size_t) { return true; });
        for (std::size_t i = 0; i < run.steps.size(); ++i) run.steps[i].ms = spread([&](std::size_t step) { return step == i; });
        for (const auto& [stage, choice] : run.choices) {
            // A scope is named "place: stage/technique", so a technique's acts count for it wherever they stand.
            const std::string technique = ": " + choice.substr(0, choice.find(' '));
            run.stage_ms[stage] = spread([&](std::size_t step) { return run.steps[step].scope.ends_with(technique); });
        }
    }

    void remember(const Declaration& d, const std::vector<CounterRecord>& counters) {
        for (const auto& [key, technique] : d.memo_writes) {
            std::vector<CounterRecord> own;
            std::ranges::copy_if(counters, std::back_inserter(own),
                                 [&](const CounterRecord& c) { return c.technique == technique->name; });
            memo_.commit(key, std::move(own));
        }
    }

    std::unique_ptr<Device> device_;
    std::unique_ptr<Executor> executor_;
    DeviceScene scene_;
    Memo memo_;
    std::unique_ptr<LoadedFrame> loaded_;
    Source source_;
};

Result<DeviceSession::Inspected> DeviceSession::inspect(const Request& request, Stage stage) {
    auto declared = prepare(request, nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const auto acts = std::span(declared->frame.acts);
    const auto own = [&](const DeclaredAct& act) { return act.technique->stage == stage; };
    const auto last = std::ranges::find_if(acts.rbegin(), acts.rend(), own);
    if (last == acts.rend()) return fail(Fault::usage, "the frame does not need the stage {}", name(stage));

    const Plan& plan = declared->plan;
    RunOptions options;
    std::vector<std::pair<std::string_view, bool>> names;  // and whether it is a result
    const auto want = [&](std::string_view image_name, Image image, std::size_t end, bool result) {
        if (!image || declared->graph.shape(image).samples > 1) return;
        if (const auto step = last_write(plan, image, end)) {
            options.peeks.push_back({*step, image});
            names.emplace_back(image_name, result);
        }
    };
    for (const FrameImageRow& row : frame_images())
        want(row.name, last->before.*row.member, first_step_after(plan, last->scope - 1), false);
    for (const std::string_view output : info(stage).outputs)
        want(output, declared->images.*find_frame_image(output)->member, first_step_after(plan, last->scope), true);

    const auto execution = execute(*declared, options);
    if (!execution) return execution.error();
    Inspected inspected{.choice = declared->choices.at(stage)};
    for (std::size_t i = 0; i < names.size(); ++i)
        (names[i].second ? inspected.result : inspected.before)
            .insert_or_assign(std::string(names[i].first), in_double(execution->peeked[i]));
    return inspected;
}

Result<std::vector<ActImages>> DeviceSession::act_images(const Request& request) {
    auto declared = prepare(request, nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const Plan& plan = declared->plan;
    std::vector<ActImages> acts;
    RunOptions options;
    std::vector<std::pair<std::size_t, std::string_view>> places;  // of each peek: act and image
    for (const DeclaredAct& act : declared->frame.acts) {
        const Stage stage = act.technique->stage;
        for (const std::string_view output : info(stage).outputs) {
            const Image image = declared->images.*find_frame_image(output)->member;
            if (!image || declared->graph.shape(image).samples > 1) continue;
            const auto step = last_write(plan, image, first_step_after(plan, act.scope));
            if (!step || plan.steps[*step].step.scope != act.scope) continue;
            options.peeks.push_back({*step, image});
            places.emplace_back(acts.size(), output);
        }
        std::string label(name(stage));
        if (act.at != stage) label += fmt::format(" at {}", name(act.at));
        acts.push_back({stage, act.at, std::move(label), choice_line(declared->choices.at(stage)), {}});
    }
    auto execution = execute(*declared, options);
    if (!execution) return execution.error();
    for (std::size_t i = 0; i < places.size(); ++i)
        acts[places[i].first].images.emplace(places[i].second, std::move(execution->peeked[i]));
    return acts;
}

Result<std::vector<StepImages>> DeviceSession::step_images(const Request& request, Stage stage) {
    const auto declared = prepare(request, nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const Plan& plan = declared->plan;
    std::set<std::uint32_t> scopes;
    for (const DeclaredAct& act : declared->frame.acts)
        if (act.technique->stage == stage) scopes.insert(act.scope);
    std::vector<StepImages> steps;
    RunOptions options;
    std::vector<std::size_t> places;  // of each peek, in steps
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const Step& step = plan.steps[i].step;
        if (!scopes.contains(step.scope)) continue;
        std::set<std::uint32_t> written;
        for (const Barrier& barrier : plan.steps[i].barriers) {
            if (!barrier.image || !writes(barrier.after) || declared->graph.shape(barrier.image).samples > 1) continue;
            if (!written.insert(barrier.image.id).second) continue;  // one barrier per mip and layer
            options.peeks.push_back({i, barrier.image});
            places.push_back(steps.size());
        }
        steps.push_back({i, plan.scopes[step.scope].name, step.name, {}});
    }
    auto execution = execute(*declared, options);
    if (!execution) return execution.error();
    for (std::size_t i = 0; i < places.size(); ++i)
        steps[places[i]].images.emplace(plan.images[options.peeks[i].image.id].name, std::move(execution->peeked[i]));
    return steps;
}

Result<ImageSet> DeviceSession::truth(const Request& request, Stage stage) {
    const auto inspected = inspect(request, stage);
    if (!inspected) return inspected.error();
    return info(stage).truth({loaded_->frame, inspected->before});
}

Result<Accuracy> DeviceSession::judge(const Request& request, Stage stage, Against against, const ImageSet* truth) {
    const auto inspected = inspect(request, stage);
    if (!inspected) return inspected.error();
    return judge_stage(
        {loaded_->frame, loaded_->features, inspected->choice, inspected->before, inspected->result, against, truth});
}

Result<std::unique_ptr<Session>> open_session(const DeviceChoice& choice, DeviceSession::Source source) {
    auto device = Device::open(choice);
    if (!device) return device.error();
    return std::unique_ptr<Session>(std::make_unique<DeviceSession>(*std::move(device), std::move(source)));
}

}  // namespace

Result<std::unique_ptr<Session>> Session::open(const std::filesystem::path& path, const DeviceChoice& choice, Partial partial) {
    auto capture = Capture::open(path, partial);
    if (!capture) return capture.error();
    if (capture->frame_count() == 0) return fail(Fault::bad_input, "{} holds no frame", path.string());
    return open_session(choice, *std::move(capture));
}

Result<std::unique_ptr<Session>> Session::open(std::vector<Frame> frames, const DeviceChoice& choice) {
    return open_session(choice, std::move(frames));
}

}  // namespace strata
