#include "ui/report/modeled_costs.h"

#include "replay/report/report_columns.h"
#include "replay/report/variants.h"

namespace strata::ui {

Result<ModeledCosts> model_costs(Session& session, const ModeledRequest& wanted, const strata::Progress& tell) {
    const std::string_view gpu = wanted.model->name;
    ModeledCosts costs{.column = {.kind = ReportColumn::Kind::cost,
                                  .head = fmt::format("kcycles {}", gpu),
                                  .label = fmt::format("modeled kilocycles of {}", gpu),
                                  .values = {}},
                       .missing = {}};
    const Described is{.key = "kilocycles", .title = costs.column.head, .help = ""};
    for (const Measurement& row : wanted.report.rows) {
        const std::size_t done = costs.column.values.size();
        tell(fmt::format("{} on {}", short_label(row), gpu), double(done) / double(wanted.report.rows.size()));
        auto made = model_cost(session, wanted.base, row, *wanted.model, wanted.program);
        if (!made) return made.error();
        costs.column.values.push_back(made->kilocycles);
        costs.column.texts.push_back(window_cell(is, cell_or_nothing(made->kilocycles)).text);
        costs.missing.push_back(std::move(made->missing));
    }
    return costs;
}

}  // namespace strata::ui
