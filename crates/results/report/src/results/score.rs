//! A score as it is read back.

use taceva_core::Unit;
use taceva_metrics::{Better, Curve, Map, Matrix, Scale, Standing, catalogue};

/// A metric of a channel or plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// The metric: `mae`.
    pub metric: String,
    /// The channel or plane: `Fz`, `Pxy`.
    pub channel: String,
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// How many samples it is computed from.
    pub n: u64,
    /// Samples left out because a value was no usable number.
    pub n_invalid: u64,
    /// Its 95 % interval; `None` where an interval has no meaning.
    pub interval: Option<Interval>,
    /// Which definition was computed: `mae/1`.
    pub definition: String,
    /// The constants of the definition.
    pub parameters: Vec<(String, f64)>,
    /// What was counted while it was computed, by name.
    pub counts: Vec<(String, u64)>,
    /// What a reader must know before trusting it.
    pub flags: Vec<String>,
    /// Whether it takes part in verdicts.
    pub standing: Standing,
    /// Which share of the predictions it was formed with lie beyond the bounds of the model; `None` where no prediction enters it or nobody
    /// wrote it down.
    pub bounded_share: Option<f64>,
    /// The channels that it is computed from, where they are several.
    pub of: Vec<String>,
    /// Other values of the same metric and channel.
    pub variants: Vec<Variant>,
}

/// Another value of the same metric and channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Its name: `slope`, `map`.
    pub name: String,
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// Its 95 % interval; `None` where an interval has no meaning.
    pub interval: Option<Interval>,
}

/// What a score can be.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// One finite number.
    Number(f64),
    /// A number for each place of the sensing surface.
    Map(Map),
    /// A number for each level of another quantity.
    Curve(Curve),
    /// A number for each pair of names.
    Matrix(Matrix),
    /// The samples determine no value: why.
    Undefined(String),
    /// The question does not arise: why.
    NotApplicable(String),
}

/// A confidence interval of 95 %.
#[derive(Clone, Debug, PartialEq)]
pub enum Interval {
    /// Both ends, and how they were found.
    Ends {
        /// The lower and the upper end.
        ends: [f64; 2],
        /// How they were found: `jackknife by point_id, G=32`.
        method: String,
        /// The standard error behind them, in the unit of the score; not known of results of schema 1.0.
        standard_error: Option<f64>,
        /// The number of clusters behind them; not known of results of schema 1.0.
        clusters: Option<u64>,
        /// Degrees of freedom of Student's t behind them; not known of results before schema 1.3.
        degrees_of_freedom: Option<f64>,
    },
    /// There is none: why.
    Absent(String),
}

impl Score {
    /// The variant called `name`.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }

    /// Whether the score, or its variant of that name, takes part in verdicts, and if not, why: a reference constant is no claim of the model, and always counts.
    pub fn standing_of(&self, variant: Option<&str>) -> Standing {
        match variant {
            Some("of_constant" | "constant") => Standing::Counts,
            _ => self.standing,
        }
    }

    /// Whether lower or higher values are better; neither of metrics that are not known here.
    pub fn better(&self) -> Better {
        catalogue::find(&self.metric).map_or(Better::Described, |metric| metric.better)
    }
}

impl Value {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Why there is no value, in words.
    pub fn reason(&self) -> Option<String> {
        match self {
            Value::Undefined(reason) => Some(format!("undefined: {reason}")),
            Value::NotApplicable(reason) => Some(format!("not applicable: {reason}")),
            _ => None,
        }
    }
}

impl Interval {
    /// Both ends, if there is an interval.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Interval::Ends { ends, .. } => Some(*ends),
            Interval::Absent(_) => None,
        }
    }

    /// How it was found.
    pub fn method(&self) -> Option<&str> {
        match self {
            Interval::Ends { method, .. } => Some(method),
            Interval::Absent(_) => None,
        }
    }

    /// Degrees of freedom of Student's t behind it, if the result says so.
    pub fn degrees_of_freedom(&self) -> Option<f64> {
        match self {
            Interval::Ends {
                degrees_of_freedom, ..
            } => *degrees_of_freedom,
            Interval::Absent(_) => None,
        }
    }

    /// On which scale its ends lie about the value, by the words of its method.
    pub fn scale(&self) -> Scale {
        const SCALES: [Scale; 4] = [Scale::Logarithm, Scale::Logit, Scale::Cut, Scale::Wilson];
        let method = self.method().unwrap_or_default();
        let is_said = |scale: &Scale| method.contains(&scale.to_string());
        SCALES.into_iter().find(is_said).unwrap_or(Scale::Own)
    }

    /// The number of clusters that it was found from, if the result or its method says so.
    pub fn clusters(&self) -> Option<usize> {
        if let Interval::Ends {
            clusters: Some(clusters),
            ..
        } = self
        {
            return usize::try_from(*clusters).ok();
        }
        let (_, rest) = self.method()?.split_once("G=")?;
        let digits = rest.find(|letter: char| !letter.is_ascii_digit());
        rest[..digits.unwrap_or(rest.len())].parse().ok()
    }
}
