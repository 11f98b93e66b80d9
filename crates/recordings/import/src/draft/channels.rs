//! Lines of `[columns]` of a map: the best candidate column for each channel, with the other candidates in a comment.

use std::fmt::Write;

use super::roles::candidate::{Candidate, Reason};

/// Candidate column for a channel, with its name in a map.
pub(super) struct Offered<'t> {
    pub(super) name: &'t str,
    pub(super) candidate: &'t Candidate,
    /// True for a column of the main table.
    pub(super) is_own: bool,
}

impl Offered<'_> {
    fn from(&self) -> String {
        format!("{:?}", format!("{}{}", self.name, self.candidate.index))
    }

    fn unit(&self) -> &'static str {
        self.candidate.unit.map_or("?", |(unit, _)| unit)
    }

    /// Map keys that state the unit and scale of the column.
    fn facts(&self) -> String {
        let scale = self.candidate.unit.and_then(|(_, source)| source.scale());
        let scale = scale.map(|scale| format!(", scale = {scale}"));
        format!("unit = {:?}{}", self.unit(), scale.unwrap_or_default())
    }

    /// Rank among the candidates of a channel; the lowest is the best. `is_stated` is true if the best candidate states a unit. Columns of counts or
    /// volts then rank last.
    fn rank(&self, is_stated: bool) -> (bool, bool, Reason, bool, u32) {
        (
            self.candidate.open.is_some(),
            is_stated && self.candidate.is_unscaled,
            self.candidate.reason,
            !self.is_own,
            self.place_in_pose(),
        )
    }

    /// Rank of a column whose cells are a pose as a list of lists: the position precedes the rotation.
    fn place_in_pose(&self) -> u32 {
        let is_place = self.candidate.channel.starts_with('P');
        let last = self.name.rsplit('/').next().filter(|_| is_place);
        last.and_then(|last| last.parse().ok()).unwrap_or_default()
    }

    fn line(&self) -> String {
        let Candidate {
            channel, reason, ..
        } = self.candidate;
        let unit = self.candidate.unit.map(|(_, source)| format!("; {source}"));
        format!(
            "{channel} = {{ from = {}, {} }}   # {reason}{}",
            self.from(),
            self.facts(),
            unit.unwrap_or_default()
        )
    }
}

/// Lines of all channels, in column order. A line has a gap (`"?"`) if two candidates share the best rank.
pub(super) fn lines(offered: &[Offered<'_>]) -> String {
    let mut text = String::new();
    for channel in taceva_core::distinct(offered.iter().map(|one| one.candidate.channel)) {
        let of_channel = offered
            .iter()
            .filter(|one| one.candidate.channel == channel);
        let mut ranked: Vec<&Offered<'_>> = of_channel.collect();
        // A unit counts only if its column would come first.
        let best = ranked.iter().min_by_key(|one| one.rank(true));
        let is_stated = best.is_some_and(|best| best.candidate.unit.is_some());
        ranked.sort_by_key(|one| one.rank(is_stated));
        let Some((first, others)) = ranked.split_first() else {
            continue;
        };
        let alike: Vec<&&Offered<'_>> = others
            .iter()
            .take_while(|other| other.rank(is_stated) == first.rank(is_stated))
            .collect();
        match (&first.candidate.open, alike.as_slice()) {
            (Some(why), _) => {
                let _ = writeln!(
                    text,
                    "{channel} = {{ from = \"?\", {} }}   # {} {why}",
                    first.facts(),
                    first.from()
                );
            }
            (None, []) => text += &format!("{}\n", first.line()),
            (None, alike) => {
                let names: Vec<String> = std::iter::once(first)
                    .chain(alike.iter().copied())
                    .map(|one| one.from())
                    .collect();
                let facts = match alike.iter().all(|one| one.facts() == first.facts()) {
                    true => first.facts(),
                    false => "unit = \"?\"".to_owned(),
                };
                let _ = writeln!(
                    text,
                    "{channel} = {{ from = \"?\", {facts} }}   # {} match equally by {}: name the measured column",
                    names.join(", "),
                    first.candidate.reason
                );
            }
        }
        for other in others.iter().skip(alike.len()) {
            let _ = writeln!(text, "# or: {}", other.line());
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draft::roles::candidate::Named;

    fn drafted(names: &[&str]) -> String {
        let candidates: Vec<Candidate> = names
            .iter()
            .filter_map(|name| Named::new(name).candidate(String::new())?.ok())
            .collect();
        let offered: Vec<Offered<'_>> = names
            .iter()
            .zip(&candidates)
            .map(|(name, candidate)| Offered {
                name,
                candidate,
                is_own: true,
            })
            .collect();
        lines(&offered)
    }

    #[test]
    fn the_name_of_the_channel_comes_before_its_name_with_a_unit_and_that_before_words() {
        let text = drafted(&["force_z", "Fz_N", "Fz"]);
        let first: Vec<&str> = text.lines().collect();
        assert_eq!(
            first[0],
            "Fz = { from = \"Fz\", unit = \"?\" }   # its name"
        );
        assert!(first[1].starts_with("# or: Fz = { from = \"Fz_N\", unit = \"N\" }"));
        assert!(first[2].starts_with("# or: Fz = { from = \"force_z\""));
    }

    #[test]
    fn counts_and_raw_numbers_come_after_a_column_that_states_its_unit() {
        for raw in ["force_z_adc", "force_z_raw"] {
            let text = drafted(&[raw, "left_force_z_N"]);
            let expected = "Fz = { from = \"left_force_z_N\", unit = \"N\" }";
            assert!(text.starts_with(expected), "{text}");
            let other = format!("# or: Fz = {{ from = {raw:?}, unit = \"?\" }}");
            assert!(text.contains(&other), "{text}");
        }
    }

    #[test]
    fn a_weaker_candidate_with_a_unit_leaves_two_of_one_rank_open() {
        let text = drafted(&["fz_raw", "fz_filtered", "load_cell_N"]);
        let first = text.lines().next().expect("a line");
        assert!(first.starts_with("Fz = { from = \"?\""), "{text}");
        for name in ["fz_raw", "fz_filtered"] {
            assert!(first.contains(&format!("{name:?}")), "{text}");
        }
        assert!(
            text.contains("\n# or: Fz = { from = \"load_cell_N\""),
            "{text}"
        );
    }

    #[test]
    fn two_candidates_of_one_rank_leave_the_line_open_with_both_named() {
        for names in [
            ["fz_raw", "fz_filtered"],
            ["left_fz", "right_fz"],
            ["sensor1.force.z", "sensor2.force.z"],
        ] {
            let text = drafted(&names);
            assert!(
                text.starts_with("Fz = { from = \"?\", unit = \"?\" }"),
                "{text}"
            );
            for name in names {
                assert!(text.contains(&format!("{name:?}")), "{text}");
            }
        }
    }
}
