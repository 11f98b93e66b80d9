//! Checks of the keys of a source.

use taceva_core::shown;

use super::Reader;
use crate::budget::error::{BudgetError, BudgetProblem};
use crate::budget::schema::WrittenSource;

/// Figures that a mean of several readings at one place does not reduce.
const LASTING: [&str; 7] = [
    "error",
    "error.between",
    "bias",
    "drift",
    "hysteresis",
    "r_light",
    "certificate",
];

/// True for a figure that averaging does not reduce, including gauge components other than repeatability.
fn is_lasting(figure: &str) -> bool {
    let component = figure.rsplit_once('#').map(|(_, name)| name);
    LASTING.contains(&figure) || component.is_some_and(|name| name != "repeatability")
}

impl Reader<'_> {
    /// Requires exactly one of `from`, `u`, `U`, `s`, `rows` and `half_width`, and rejects keys that do not go with it.
    pub(super) fn check_keys(&self, of: &WrittenSource) -> Result<(), BudgetError> {
        let origins = [
            of.from.is_some(),
            of.u.is_some(),
            of.expanded.is_some(),
            of.s.is_some(),
            of.rows.is_some(),
            of.half_width.is_some(),
        ];
        let error = |problem: String| {
            let problem = BudgetProblem::Keys(problem);
            Err(self.text.error(&of.name, "source", problem))
        };
        if origins.into_iter().filter(|is_there| *is_there).count() != 1 {
            return error(format!(
                "source `{}` needs exactly one of `from`, `u`, `U`, `s`, `rows`, `half_width`",
                shown(of.name.get_ref())
            ));
        }
        let lasting = of.from.as_ref().map(|from| from.get_ref().as_str());
        let lasting = lasting.filter(|from| is_lasting(from) && of.readings.is_some());
        if let Some(from) = lasting {
            return error(format!(
                "`{from}` is the same in every reading of a place: remove `readings`"
            ));
        }
        let is_from = |name: &str| of.from.as_ref().is_some_and(|from| from.get_ref() == name);
        let is_shape = |name: &str| of.shape.as_ref().is_some_and(|of| of.get_ref() == name);
        let (own, expanded) = (
            of.from.is_none() && of.rows.is_none(),
            of.expanded.is_some(),
        );
        let many = of.s.is_some() || of.from.is_some();
        let bent = is_shape("curvilinear_trapezoid");
        let numbers = "u`, `U`, `s` or `half_width";
        // Key, true if the key is present, true if it is allowed, and the key to which it belongs.
        let keys = [
            ("k", of.k.is_some(), expanded, "U"),
            ("p", of.p.is_some(), expanded, "U"),
            ("readings", of.readings.is_some(), many, "s` or `from"),
            (
                "hours",
                of.hours.is_some(),
                is_from("drift"),
                "from = \"drift\"",
            ),
            (
                "shape",
                of.shape.is_some(),
                of.half_width.is_some(),
                "half_width",
            ),
            (
                "beta",
                of.beta.is_some(),
                is_shape("trapezoid"),
                "shape = \"trapezoid\"",
            ),
            (
                "limits",
                of.limits.is_some(),
                bent,
                "shape = \"curvilinear_trapezoid\"",
            ),
            ("dof", of.dof.is_some(), own, numbers),
            ("reliability", of.reliability.is_some(), own, numbers),
            ("value", of.value.is_some(), own, numbers),
            ("enters", of.enters.is_some(), own, numbers),
        ];
        let stray = keys.into_iter().find(|key| key.1 && !key.2);
        if let Some((key, _, _, owner)) = stray {
            return error(format!("the key `{key}` belongs to `{owner}`"));
        }
        if of.expanded.is_some() && of.k.is_some() == of.p.is_some() {
            let needs = "`U` needs its coverage factor `k`, or its probability `p` with `dof`";
            return error(needs.to_owned());
        }
        if of.dof.is_some() && of.reliability.is_some() {
            return error("`dof` and `reliability` state the same; remove one of them".to_owned());
        }
        Ok(())
    }
}
