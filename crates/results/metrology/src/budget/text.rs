//! Parser of `budget.toml`, with all checks that are possible without measured figures.

use taceva_core::{Channel, Unit, nearest, shown, suggestion};

use super::amount::{Amount, Wanted};
use super::error::{BudgetError, BudgetProblem};
use super::schema::WrittenBudget;

/// Parsed budget file, `budget_version = 1`.
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
    /// Byte offset of the start of each line.
    starts: Vec<usize>,
    /// Unit of the measurand, to which sources are converted; `None` for a unit that TacEva cannot convert.
    pub(super) kept_unit: Option<Unit>,
    pub(super) unit: String,
    pub(super) coverage: f64,
    /// Values of the measurand, one budget each.
    pub(super) at: Vec<f64>,
}

impl BudgetText {
    /// Parses a budget file.
    ///
    /// # Errors
    /// [`BudgetError`] with line, key and expectation.
    pub fn parse(text: &str) -> Result<BudgetText, BudgetError> {
        let mut starts = vec![0];
        starts.extend(text.match_indices('\n').map(|(at, _)| at + 1));
        let line = |offset: usize| starts.partition_point(|start| *start <= offset);
        let written: WrittenBudget = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|span| line(span.start));
            BudgetError::new(place, "", BudgetProblem::Syntax(explained(error.message())))
        })?;
        let version = *written.budget_version.get_ref();
        if version != 1 {
            let place = line(written.budget_version.span().start);
            let problem = value(f64::from(version), "1");
            return Err(BudgetError::new(place, "budget_version", problem));
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
        let channel = Channel::SIX.into_iter().find(|of| of.name() == name);
        let own = channel.map(|channel| channel.unit());
        let keys = |problem: String| {
            let problem = BudgetProblem::Keys(problem);
            Err(self.error(&self.written.measurand, "unit", problem))
        };
        let unit = match (&self.written.unit, own) {
            (Some(unit), _) => unit.get_ref().clone(),
            (None, Some(own)) => own.to_string(),
            (None, None) => {
                let hint = suggestion(name, &["Px", "Py", "Pz", "Fx", "Fy", "Fz"]);
                let name = shown(name);
                return keys(format!(
                    "`{name}` is not a channel, so the key `unit` is needed; {hint}"
                ));
            }
        };
        let kept = Unit::from_symbol(&unit);
        let label = shown(&unit);
        if let Some(own) = own.filter(|own| kept != Some(*own)) {
            return keys(format!(
                "`{label}` is found, expected {own}, the unit of {name}"
            ));
        }
        match (kept, &self.written.expression) {
            (None, None) => {
                let units = Unit::ALL.map(|unit| unit.symbol()).join(", ");
                return keys(format!(
                    "the unit `{label}` needs an `expression`; without one the unit is one of {units}"
                ));
            }
            (Some(Unit::Degree), Some(_)) => {
                let needs = "angles of an `expression` are in radians; state `unit = \"rad\"`";
                return keys(needs.to_owned());
            }
            _ => {}
        }
        (self.kept_unit, self.unit) = (kept, unit);
        let wanted = self.wanted();
        let resolved = |at: &toml::Spanned<Amount>| {
            let found = at.get_ref().resolve(wanted);
            found.map_err(|problem| self.error(at, "at", problem))
        };
        self.at = self
            .written
            .at
            .iter()
            .map(resolved)
            .collect::<Result<_, _>>()?;
        if self.at.is_empty() && self.written.expression.is_none() {
            let problem =
                BudgetProblem::Keys("the key `at` is missing, such as `at = [\"1 N\"]`".to_owned());
            return Err(self.error(&self.written.measurand, "at", problem));
        }
        Ok(())
    }

    /// Name of the measurand.
    pub fn measurand(&self) -> &str {
        self.written.measurand.get_ref()
    }

    /// Unit of the measurand and of its uncertainty.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Values of the measurand in its unit, one budget each.
    pub fn at(&self) -> &[f64] {
        &self.at
    }

    /// The same budget file with other values of the measurand, in its unit.
    #[must_use]
    pub fn with_at(self, at: Vec<f64>) -> BudgetText {
        BudgetText { at, ..self }
    }

    /// True if the budget file has a source.
    pub fn has_source(&self) -> bool {
        !self.written.source.is_empty()
    }

    /// Measured figures that sources use by `from`, in the order of the budget file.
    pub fn figures(&self) -> impl Iterator<Item = &str> {
        let named = self.written.source.iter();
        let named = named.filter_map(|source| source.get_ref().from.as_ref());
        named.map(|from| from.get_ref().as_str())
    }

    /// Error for the source that uses `figure`, which has no value for `reason`.
    pub fn not_measured(&self, figure: &str, reason: &str) -> BudgetError {
        let mut named = self.written.source.iter();
        let from = named.find_map(|source| {
            let from = source.get_ref().from.as_ref();
            from.filter(|from| from.get_ref() == figure)
        });
        let problem = BudgetProblem::NotMeasured {
            name: shown(figure).to_string(),
            reason: reason.to_owned(),
        };
        BudgetError::new(from.map(|from| self.line(from)), "from", problem)
    }

    /// Expected unit of the measurand and of sources that are added to it.
    pub(super) fn wanted(&self) -> Wanted {
        match (self.kept_unit, &self.written.expression) {
            (Some(unit), None) => Wanted::In(unit),
            (Some(_), Some(_)) => Wanted::Any,
            (None, _) => Wanted::Plain,
        }
    }

    /// Line of a value, from 1.
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

/// Problem of a number outside its range.
pub(super) fn value(found: f64, expected: &str) -> BudgetProblem {
    BudgetProblem::Value {
        found: found.to_string(),
        expected: expected.to_owned(),
    }
}

/// The TOML parser's message in one line, with the nearest key for an unknown key.
pub(super) fn explained(message: &str) -> String {
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
