//! Text of a budget: `budget.toml`, checked as far as it can be without measured figures.

use taceva_core::{Channel, Unit, nearest, shown, suggestion};

use super::amount::Wanted;
use super::error::{BudgetError, BudgetProblem};
use super::schema::WrittenBudget;

/// A budget as written, `budget_version = 1`.
///
/// ```
/// use taceva_metrology::budget::{BudgetText, Evidence, MonteCarlo};
/// let text = BudgetText::parse(r#"
/// budget_version = 1
/// measurand = "Fz"
/// at = ["0.5 N"]
/// [[source]]
/// name = "lighting"
/// half_width = "10 mN"
/// shape = "rectangular"
/// "#)?;
/// let budgets = text.budgets(&Evidence::default(), None::<MonteCarlo>)?;
/// assert!((budgets[0].u - 0.010 / 3_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), taceva_metrology::budget::BudgetError>(())
/// ```
///
/// # Reference
/// JCGM 100:2008 (GUM), clauses 4, 5 and annex G.
#[derive(Clone, Debug)]
pub struct BudgetText {
    pub(super) written: WrittenBudget,
    /// Offsets of the beginnings of lines.
    starts: Vec<usize>,
    /// Unit of the measurand that sources are converted to; `None` if it is free text.
    pub(super) kept_unit: Option<Unit>,
    pub(super) unit: String,
    pub(super) coverage: f64,
    /// Values of the measurand at which a budget is made.
    pub(super) at: Vec<f64>,
}

impl BudgetText {
    /// Reads the text of a budget.
    ///
    /// # Errors
    /// [`BudgetError`] with line, key and expectation.
    pub fn parse(text: &str) -> Result<BudgetText, BudgetError> {
        let line_ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let starts: Vec<usize> = std::iter::once(0)
            .chain(line_ends.map(|(at, _)| at + 1))
            .collect();
        let line = |offset: usize| starts.partition_point(|start| *start <= offset);
        let written: WrittenBudget = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|span| line(span.start));
            BudgetError::new(place, "", BudgetProblem::Syntax(explained(error.message())))
        })?;
        let version = *written.budget_version.get_ref();
        if version != 1 {
            let place = line(written.budget_version.span().start);
            return Err(BudgetError::new(
                place,
                "budget_version",
                BudgetProblem::Version(version),
            ));
        }
        let mut budget = BudgetText {
            written,
            starts,
            kept_unit: None,
            unit: String::new(),
            coverage: 0.95,
            at: Vec::new(),
        };
        budget.resolve()?;
        Ok(budget)
    }

    fn resolve(&mut self) -> Result<(), BudgetError> {
        if let Some(coverage) = &self.written.coverage {
            self.coverage = *coverage.get_ref();
            if !(self.coverage > 0.0 && self.coverage < 1.0) {
                let problem = value(self.coverage, "a number between 0 and 1");
                return Err(self.error(coverage, "coverage", problem));
            }
        }
        let name = self.written.measurand.get_ref();
        let channel = Channel::SIX
            .into_iter()
            .find(|channel| channel.name() == name);
        match (&channel, &self.written.unit) {
            (Some(channel), None) => self.kept_unit = Some(channel.unit()),
            (None, None) => {
                let names = Channel::SIX.map(|channel| channel.name().to_owned());
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let hint = suggestion(name, &names);
                let problem = BudgetProblem::Keys(format!(
                    "`{}` is no channel, so the key `unit` is needed; {hint}",
                    shown(name)
                ));
                return Err(self.error(&self.written.measurand, "measurand", problem));
            }
            (_, Some(unit)) => {
                self.kept_unit = Unit::from_symbol(unit.get_ref());
                if let Some(channel) =
                    channel.filter(|channel| Some(channel.unit()) != self.kept_unit)
                {
                    let problem = BudgetProblem::Value {
                        found: shown(unit.get_ref()).to_string(),
                        expected: format!("{}, the unit of {name}", channel.unit()),
                    };
                    return Err(self.error(unit, "unit", problem));
                }
            }
        }
        let written = self
            .written
            .unit
            .as_ref()
            .map(|unit| unit.get_ref().clone());
        self.unit = written
            .or_else(|| self.kept_unit.map(|unit| unit.to_string()))
            .unwrap_or_default();
        if self.written.expression.is_none() && self.kept_unit.is_none() {
            let units = Unit::ALL.map(|unit| unit.symbol()).join(", ");
            let problem = BudgetProblem::Keys(format!(
                "the unit `{}` needs an `expression`; without one the unit is one of {units}",
                shown(&self.unit)
            ));
            return Err(self.error(&self.written.measurand, "unit", problem));
        }
        let wanted = match (self.kept_unit, &self.written.expression) {
            (Some(unit), None) => Wanted::In(unit),
            _ => Wanted::Any,
        };
        let at: Result<Vec<f64>, BudgetError> = self
            .written
            .at
            .iter()
            .map(|at| {
                at.get_ref()
                    .resolve(wanted)
                    .map_err(|problem| self.error(at, "at", problem))
            })
            .collect();
        self.at = at?;
        if self.at.is_empty() && self.written.expression.is_none() {
            let problem =
                BudgetProblem::Keys("the key `at` is missing, such as `at = [\"1 N\"]`".to_owned());
            return Err(self.error(&self.written.measurand, "at", problem));
        }
        Ok(())
    }

    /// Line of a value.
    pub(super) fn line<T>(&self, of: &toml::Spanned<T>) -> usize {
        let offset = of.span().start;
        self.starts.partition_point(|start| *start <= offset)
    }

    pub(super) fn error<T>(
        &self,
        of: &toml::Spanned<T>,
        key: &str,
        problem: BudgetProblem,
    ) -> BudgetError {
        BudgetError::new(self.line(of), key, problem)
    }
}

/// The problem of a number out of its range.
pub(super) fn value(found: f64, expected: &str) -> BudgetProblem {
    BudgetProblem::Value {
        found: found.to_string(),
        expected: expected.to_owned(),
    }
}

/// The parser's message in one line, with the nearest key for an unknown one.
fn explained(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [wrong, known @ ..] if message.starts_with("unknown field") => {
            let guess = nearest(wrong, known.iter().copied())
                .map_or_else(String::new, |guess| format!(", did you mean `{guess}`?"));
            format!(
                "`{}`: unknown key{guess}; known here: {}",
                shown(wrong),
                known.join(", ")
            )
        }
        [missing] if message.starts_with("missing field") => {
            format!("the key `{}` is missing", shown(missing))
        }
        _ => shown(&message.trim_end().replace('\n', "; ")).to_string(),
    }
}
