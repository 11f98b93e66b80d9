//! Assigns frames to contacts with the gel.

use taceva_dataset::Table;

/// Normal force above which a contact begins, in N.
const BEGINS_N: f64 = 0.1;
/// Normal force below which a contact ends, in N.
const ENDS_N: f64 = 0.05;

/// Numbering of the contacts of a capture. The first contact is `hand-1`, and the time before it is `rest-0`.
///
/// A rest is not a contact point. Frames of one rest have the same name, so that a training/test split does not separate them.
#[derive(Debug)]
pub(super) struct Contacts {
    count: u64,
    is_touched: bool,
}

impl Contacts {
    /// Continues the numbering of the contacts in `table`.
    pub(super) fn after(table: &Table) -> Contacts {
        let names = table.point_id().iter().flatten();
        let numbers = names.filter_map(|name| name.strip_prefix("hand-")?.parse().ok());
        Contacts {
            count: numbers.max().unwrap_or(0),
            is_touched: false,
        }
    }

    /// Number of contacts that have begun.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// Name of the contact or rest of a frame with the normal force `normal_n`. Without a force, the name of the previous frame.
    pub(super) fn name(&mut self, normal_n: Option<f64>) -> String {
        match normal_n {
            Some(normal_n) if !self.is_touched && normal_n > BEGINS_N => {
                self.is_touched = true;
                self.count += 1;
            }
            Some(normal_n) if self.is_touched && normal_n < ENDS_N => self.is_touched = false,
            _ => {}
        }
        let what = if self.is_touched { "hand" } else { "rest" };
        format!("{what}-{}", self.count)
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Channels;

    use super::*;

    #[test]
    fn a_touch_begins_above_a_tenth_of_a_newton_and_ends_below_half_of_it() {
        let nothing = Table::new(Channels::new([]).expect("none"), Vec::new());
        let mut contacts = Contacts::after(&nothing);
        let forces = [
            Some(0.0),
            Some(0.1),
            Some(0.11),
            Some(0.06),
            None,
            Some(0.04),
            Some(0.09),
            Some(3.0),
        ];
        let names: Vec<String> = forces.into_iter().map(|at| contacts.name(at)).collect();
        assert_eq!(
            names,
            [
                "rest-0", "rest-0", "hand-1", "hand-1", "hand-1", "rest-1", "rest-1", "hand-2"
            ]
        );
        assert_eq!(contacts.count(), 2);
    }
}
