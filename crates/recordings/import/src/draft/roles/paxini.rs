//! Resultant force of a module in a table of `paxini-sdk`, such as `1-2-1x1-Z`.

use super::candidate::{Candidate, Quantity, Reason, UnitSource};

/// Candidate for the force along the axis at the end of `name`; `None` for other names.
pub(super) fn resultant(name: &str) -> Option<Candidate> {
    let parts: Vec<&str> = name.split('-').collect();
    let [bus, module, form, axis] = parts[..] else {
        return None;
    };
    if !is_number(bus) || !is_number(module) || form != "1x1" {
        return None;
    }
    let axis = ["X", "Y", "Z"].iter().position(|known| *known == axis)?;
    Some(Candidate {
        channel: Quantity::Force.channels()[axis],
        index: String::new(),
        reason: Reason::Words,
        unit: Some(("N", UnitSource::PaxiniCounts)),
        is_unscaled: false,
        open: None,
    })
}

fn is_number(part: &str) -> bool {
    !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_resultant_of_a_module_is_a_force() {
        let found = |name: &str| resultant(name).map(|found| found.channel);
        assert_eq!(found("1-2-1x1-X"), Some("Fx"));
        assert_eq!(found("0-11-1x1-Z"), Some("Fz"));
        for other in [
            "1-2-NxN-X[0]",
            "1-2-1x1-x",
            "-2-1x1-X",
            "a-2-1x1-X",
            "1x1-X",
        ] {
            assert_eq!(found(other), None, "{other}");
        }
    }
}
