//! Questions for the choice of a sensor, and the catalogue entries that answer them.

use super::entry::Sensor;

/// A fact that decides whether a sensor suits a task.
///
/// ```
/// use taceva_report::catalogue::{self, Question};
/// let digit = catalogue::find("DIGIT").expect("there");
/// assert!(digit.answers(Question::Size) && digit.answers(Question::Price));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Outer dimensions.
    Size,
    /// Thickness of the sensor or of its gel.
    Thickness,
    /// Area of the sensing surface.
    Area,
    /// Frames or measurements per second.
    Rate,
    /// Pixels of a frame, or the smallest resolved detail.
    Resolution,
    /// Error of position, depth or force.
    Accuracy,
    /// Price of the sensor.
    Price,
    /// Seller, or files for building the sensor.
    Availability,
}

impl Question {
    /// All questions, in the order of tables.
    pub const ALL: [Question; 8] = [
        Question::Size,
        Question::Thickness,
        Question::Area,
        Question::Rate,
        Question::Resolution,
        Question::Accuracy,
        Question::Price,
        Question::Availability,
    ];
}

impl Sensor {
    /// True if the entry answers `question` with a number, a seller, or files for building.
    pub fn answers(&self, question: Question) -> bool {
        let of = |metric: &str| self.results.iter().any(|result| result.metric == metric);
        let intrinsic = |channel: &str| {
            let mut results = self.results.iter();
            results.any(|result| result.metric == "intrinsic" && result.channel == channel)
        };
        match question {
            Question::Size => self.size.is_some(),
            Question::Thickness => intrinsic("thickness") || of("gel_thickness"),
            Question::Area => intrinsic("field_of_view"),
            Question::Rate => intrinsic("frame_rate") || of("measurement_rate"),
            Question::Resolution => intrinsic("resolution") || of("spatial_resolution"),
            Question::Accuracy => self.results.iter().any(|result| {
                let is_error = ["mae", "error", "rmse"]
                    .into_iter()
                    .any(|end| result.metric.ends_with(end));
                is_error && ["mm", "N"].contains(&result.unit.as_str())
            }),
            Question::Price => !self.prices.is_empty(),
            Question::Availability => !self.availability.is_empty(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{Kind, all};

    /// Sensors that can be bought or built, with the questions that each answers.
    fn answered() -> Vec<(String, Vec<Question>)> {
        let available = all()
            .into_iter()
            .filter(|entry| entry.kind == Kind::Sensor && entry.answers(Question::Availability));
        let answers = |entry: Sensor| {
            let found = Question::ALL.into_iter();
            let found: Vec<Question> = found.filter(|question| entry.answers(*question)).collect();
            (entry.name, found)
        };
        available.map(answers).collect()
    }

    #[test]
    fn of_25_sensors_that_one_can_get_five_of_eight_facts_are_known_and_of_12_an_error() {
        let mut known = answered();
        known.retain(|(_, answers)| answers.len() >= 5);
        assert!(known.len() >= 25, "{} {known:?}", known.len());
        known.retain(|(_, answers)| answers.contains(&Question::Accuracy));
        assert!(known.len() >= 12, "{} {known:?}", known.len());
    }

    #[test]
    fn a_torque_error_is_no_error_of_force_or_position() {
        let entry = |unit: &str| {
            let text = format!(
                "catalogue_version = 1\nname = \"x\"\nkind = \"sensor\"\nmechanism = []\n[[result]]\nmetric = \"some_error\"\nchannel = \"F\"\n\
                 value = 0.1\nunit = \"{unit}\"\nsource = \"s\"\nread_from = \"text\"\nconditions = \"c\"\ndefinition = \"d\"\n"
            );
            Sensor::read("x.toml", &text).expect("an entry")
        };
        assert!(entry("N").answers(Question::Accuracy));
        assert!(!entry("N·mm").answers(Question::Accuracy));
    }
}
