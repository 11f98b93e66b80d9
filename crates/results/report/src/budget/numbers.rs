//! Uncertainty budgets as a table for programs.

use taceva_metrology::budget::{Budget, Freedom, Method, Source};

use super::BudgetReport;
use crate::table::{Cell, Table};

/// Columns of the table. A row contains a source, a result, a correlation, an uncovered effect, or a warning. `low` and `high` are the ends of the
/// range of labels in the samples of a source.
const COLUMNS: [&str; 17] = [
    "at",
    "row",
    "name",
    "type",
    "shape",
    "value",
    "u",
    "degrees_of_freedom",
    "c",
    "contribution",
    "share",
    "low",
    "high",
    "unit",
    "from",
    "remark",
    "source",
];

/// Row of the table; missing numbers are empty.
#[derive(Default)]
struct Entry<'a> {
    row: &'a str,
    name: &'a str,
    kind: String,
    shape: &'a str,
    value: Option<f64>,
    u: Option<f64>,
    freedom: Option<Freedom>,
    c: Option<f64>,
    contribution: Option<f64>,
    share: Option<f64>,
    ends: Option<[f64; 2]>,
    unit: &'a str,
    from: &'a str,
    remark: String,
}

impl BudgetReport {
    /// Table for programs: numbers in shortest round-trip form, one row for each source, result, correlation, uncovered effect and warning.
    pub fn numbers(&self) -> Table {
        let mut table = Table::new("Uncertainty budget", COLUMNS);
        let origin = self.origins.join(" ");
        for budget in &self.budgets {
            let sources = budget
                .sources
                .iter()
                .map(|source| of_source(source, budget));
            for entry in sources.chain(results(budget)).chain(remarks(budget)) {
                table.push(entry.cells(budget.at, &origin));
            }
        }
        table
    }
}

fn of_source<'a>(source: &'a Source, budget: &'a Budget) -> Entry<'a> {
    Entry {
        row: "source",
        name: &source.name,
        kind: source.kind.to_string(),
        shape: &source.shape,
        value: Some(source.value),
        u: Some(source.u),
        freedom: Some(source.nu),
        c: Some(source.c),
        contribution: Some(source.contribution),
        share: source.share,
        unit: &budget.unit,
        ends: source.labels,
        from: source.from.as_deref().unwrap_or_default(),
        ..Entry::default()
    }
}

/// Rows of the value, its expanded uncertainty, the coverage factor and probability, and the Monte Carlo result.
fn results(budget: &Budget) -> Vec<Entry<'_>> {
    let unit = budget.unit.as_str();
    let result = |name, value, unit| Entry {
        row: "result",
        name,
        value,
        unit,
        ..Entry::default()
    };
    // The half-width of an interval of draws is not a multiple of u.
    let factor = budget.k.filter(|_| budget.method == Method::FirstOrder);
    let value = Entry {
        u: Some(budget.u),
        freedom: Some(budget.nu_eff),
        ends: budget.interval,
        remark: budget.method.to_string(),
        ..result(budget.measurand.as_str(), Some(budget.value), unit)
    };
    let mut all = vec![
        value,
        Entry {
            remark: budget.method.to_string(),
            ..result("U", budget.half_width(), unit)
        },
        result("k", factor, "1"),
        result("p", Some(budget.p), "1"),
        result("second_order_u", Some(budget.second_order_u), unit),
    ];
    all.extend(budget.mcm.as_ref().map(|found| Entry {
        u: Some(found.u),
        ends: Some(found.symmetric),
        remark: format!(
            "{}validated, {} draws of seed {}",
            if found.validated { "" } else { "not " },
            found.draws,
            found.seed
        ),
        ..result("monte_carlo", Some(found.mean), unit)
    }));
    all
}

/// Rows of correlations, uncovered effects, and warnings.
fn remarks(budget: &Budget) -> impl Iterator<Item = Entry<'_>> {
    let correlations = budget.correlations.iter().map(|of| Entry {
        row: "correlation",
        name: &of.between[0],
        value: Some(of.r),
        remark: of.between[1].clone(),
        ..Entry::default()
    });
    let missing = budget.missing.iter().map(|of| Entry {
        row: "missing",
        name: &of.source,
        remark: of.reason.clone(),
        ..Entry::default()
    });
    let warnings = budget.warnings.iter().map(|warning| Entry {
        row: "warning",
        remark: warning.clone(),
        ..Entry::default()
    });
    correlations.chain(missing).chain(warnings)
}

impl Entry<'_> {
    fn cells(&self, at: Option<f64>, origin: &str) -> [Cell; 17] {
        [
            Cell::exact(at),
            Cell::text(self.row),
            Cell::text(self.name),
            Cell::text(self.kind.as_str()),
            Cell::text(self.shape),
            Cell::exact(self.value),
            Cell::exact(self.u),
            Cell::exact(self.freedom.and_then(Freedom::number)),
            Cell::exact(self.c),
            Cell::exact(self.contribution),
            Cell::exact(self.share),
            Cell::exact(self.ends.map(|[low, _]| low)),
            Cell::exact(self.ends.map(|[_, high]| high)),
            Cell::text(self.unit),
            Cell::text(self.from),
            Cell::text(self.remark.as_str()),
            Cell::text(origin),
        ]
    }
}
