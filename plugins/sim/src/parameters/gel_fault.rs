//! Physical faults of a gel. Each fault changes several values of a parameter table, so that force and picture change together.

use super::{ParameterError, Parameters};

/// Fault of a gel. Recorded pictures cannot be given this fault, because the gel itself changes.
///
/// ```
/// use taceva_sim::{GelFault, Model, Parameters};
/// let fault = GelFault::from_name("friction").expect("a fault");
/// let worn = Parameters::worn_table(Model::GelSight.table(), fault, 5)?;
/// assert!((Parameters::parse(&worn)?.surface.friction - 0.4).abs() < 1e-12);
/// # Ok::<(), taceva_sim::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum GelFault {
    /// A softer gel, by age or solvents.
    Softening,
    /// A harder gel, by age or light.
    Hardening,
    /// A warmer sensor: a softer gel under weaker lamps.
    Temperature,
    /// Less friction: a greasy or powdered surface.
    Friction,
    /// A gel that moved in its housing.
    Shift,
    /// A thinner gel, by abrasion.
    Thickness,
    /// A glossier coating.
    Gloss,
    /// Bright scratches that move with the gel.
    Scratches,
    /// A dark tear that moves with the gel.
    Tear,
    /// Dark specks of dust that move with the gel.
    Dust,
}

/// Change of one value of a table.
struct Change {
    section: &'static str,
    key: &'static str,
    factor: f64,
    note: &'static str,
}

/// Softening of a gel per kelvin, a share of its stiffness.
const SOFTENING_PER_K: f64 = 0.003;
/// Loss of light of a lamp per kelvin, a share of its light.
const DIMMING_PER_K: f64 = 0.004;
/// Section and key of each parameter that states the stiffness of a gel.
const STIFFNESS: [(&str, &str); 3] = [
    ("layer", "young_modulus_mpa"),
    ("dome", "skin_n_per_mm"),
    ("dome", "gel_n_per_mm_3_2"),
];
/// Values of the section of wear, all 0 for a new gel, with their units.
const WEAR: [(&str, &str); 5] = [
    ("shift_mm", "mm"),
    ("gloss", "1"),
    ("scratches", "1"),
    ("tear_radius_mm", "mm"),
    ("dust", "1"),
];

impl GelFault {
    /// All faults.
    pub const ALL: [GelFault; 10] = [
        GelFault::Softening,
        GelFault::Hardening,
        GelFault::Temperature,
        GelFault::Friction,
        GelFault::Shift,
        GelFault::Thickness,
        GelFault::Gloss,
        GelFault::Scratches,
        GelFault::Tear,
        GelFault::Dust,
    ];

    /// Name, as in the argument `fault` of the simulated sensors.
    pub const fn name(self) -> &'static str {
        match self {
            GelFault::Softening => "gel_softening",
            GelFault::Hardening => "gel_hardening",
            GelFault::Temperature => "temperature",
            GelFault::Friction => "friction",
            GelFault::Shift => "gel_shift",
            GelFault::Thickness => "thickness",
            GelFault::Gloss => "coating_gloss",
            GelFault::Scratches => "gel_scratches",
            GelFault::Tear => "gel_tear",
            GelFault::Dust => "gel_dust",
        }
    }

    /// Cause and appearance of the fault, in one line.
    pub const fn title(self) -> &'static str {
        match self {
            GelFault::Softening => "a softer gel",
            GelFault::Hardening => "a harder gel",
            GelFault::Temperature => "a warmer sensor: a softer gel under weaker lamps",
            GelFault::Friction => "less friction",
            GelFault::Shift => "a gel that moved in its housing",
            GelFault::Thickness => "a thinner gel",
            GelFault::Gloss => "a glossier coating",
            GelFault::Scratches => "bright scratches that move with the gel",
            GelFault::Tear => "a dark tear that moves with the gel",
            GelFault::Dust => "dark dust that moves with the gel",
        }
    }

    /// Meaning and unit of the parameter of the fault.
    pub const fn parameter(self) -> &'static str {
        match self {
            GelFault::Softening => "share of the stiffness that is lost",
            GelFault::Hardening => "added stiffness, share of the original stiffness",
            GelFault::Temperature => "warming, K",
            GelFault::Friction => "share of the friction that is lost",
            GelFault::Shift => "shift along x, mm",
            GelFault::Thickness => "share of the thickness that is lost",
            GelFault::Gloss => "added directed light, share of the original directed light",
            GelFault::Scratches => "number of scratches",
            GelFault::Tear => "radius, share of the width",
            GelFault::Dust => "number of specks",
        }
    }

    /// Finds a fault by its name; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<GelFault> {
        GelFault::ALL.into_iter().find(|fault| fault.name() == name)
    }

    /// Parameter of the fault at severities 1 to 5: a share, a value in K or mm, or a count; for a tear, a share of the width.
    pub const fn amounts(self) -> [f64; 5] {
        match self {
            GelFault::Softening | GelFault::Hardening => [0.02, 0.05, 0.10, 0.20, 0.40],
            GelFault::Temperature => [2.0, 5.0, 10.0, 15.0, 20.0],
            GelFault::Friction => [0.10, 0.20, 0.30, 0.45, 0.60],
            GelFault::Shift => [0.05, 0.1, 0.2, 0.5, 1.0],
            GelFault::Thickness => [0.01, 0.02, 0.05, 0.10, 0.20],
            GelFault::Gloss => [0.05, 0.10, 0.20, 0.40, 0.60],
            GelFault::Scratches => [2.0, 5.0, 12.0, 30.0, 70.0],
            GelFault::Tear => [0.02, 0.04, 0.07, 0.11, 0.16],
            GelFault::Dust => [1.0, 3.0, 6.0, 12.0, 25.0],
        }
    }

    /// Parameter of the fault at `severity`, from 1 to 5.
    pub fn amount(self, severity: u8) -> f64 {
        self.amounts()[usize::from(severity.clamp(1, 5)) - 1]
    }

    /// Values that the fault multiplies, with their factors.
    fn changes(self, amount: f64) -> Vec<Change> {
        let scaled = |factor: f64, note| {
            let values = STIFFNESS.into_iter();
            values.map(move |(section, key)| Change {
                section,
                key,
                factor,
                note,
            })
        };
        let one = |section, key, factor, note| Change {
            section,
            key,
            factor,
            note,
        };
        match self {
            GelFault::Softening => scaled(1.0 - amount, "assumption: a softer gel").collect(),
            GelFault::Hardening => scaled(1.0 + amount, "assumption: a harder gel").collect(),
            GelFault::Temperature => {
                let softer = 1.0 - SOFTENING_PER_K * amount;
                let darker = 1.0 - DIMMING_PER_K * amount;
                let light = "assumption: lamps lose 0.4 % a kelvin";
                scaled(softer, "assumption: the gel loses 0.3 % a kelvin")
                    .chain([one("camera", "mean_gray", darker, light)])
                    .collect()
            }
            GelFault::Friction => vec![one(
                "surface",
                "friction",
                1.0 - amount,
                "assumption: a greasy surface",
            )],
            GelFault::Thickness => {
                let note = "assumption: abrasion; the skin of a dome softens in proportion to its thickness";
                [
                    ("layer", "thickness_mm"),
                    ("dome", "skin_thickness_mm"),
                    ("dome", "skin_n_per_mm"),
                ]
                .map(|(section, key)| one(section, key, 1.0 - amount, note))
                .into()
            }
            GelFault::Shift
            | GelFault::Gloss
            | GelFault::Scratches
            | GelFault::Tear
            | GelFault::Dust => Vec::new(),
        }
    }

    /// Key of the section of wear that the fault sets; `None` for faults that change other values.
    fn wear(self) -> Option<&'static str> {
        match self {
            GelFault::Shift => Some("shift_mm"),
            GelFault::Gloss => Some("gloss"),
            GelFault::Scratches => Some("scratches"),
            GelFault::Tear => Some("tear_radius_mm"),
            GelFault::Dust => Some("dust"),
            _ => None,
        }
    }
}

impl Parameters {
    /// Returns the table `text` with `fault` at `severity`, from 1 to 5. Each changed value has the origin `free` and a note with the assumption.
    ///
    /// # Errors
    /// As [`Parameters::parse`]. The changed table may be refused too: a thinner gel may no longer allow the greatest depth.
    pub fn worn_table(text: &str, fault: GelFault, severity: u8) -> Result<String, ParameterError> {
        let before = Parameters::parse(text)?;
        let amount = fault.amount(severity);
        let mut table: toml::Table = text.parse().expect("the same text was parsed before");
        for change in fault.changes(amount) {
            let entries = before.entries().iter();
            let mut entries =
                entries.filter(|entry| (entry.section, entry.key) == (change.section, change.key));
            if let Some(entry) = entries.next() {
                let value = number(entry.value * change.factor, entry.unit, change.note);
                let section = table
                    .get_mut(change.section)
                    .and_then(toml::Value::as_table_mut)
                    .expect("a section with an entry is a table");
                section.insert(change.key.to_owned(), value);
            }
        }
        if let Some(wanted) = fault.wear() {
            let amount = match fault {
                GelFault::Tear => amount * before.surface.width_mm,
                _ => amount,
            };
            let wear = WEAR.map(|(key, unit)| {
                let value = if key == wanted { amount } else { 0.0 };
                (key.to_owned(), number(value, unit, "assumption: wear"))
            });
            let wear: toml::Table = wear.into_iter().collect();
            table.insert("wear".to_owned(), toml::Value::Table(wear));
        }
        let worn = table.to_string();
        Parameters::parse(&worn)?;
        Ok(worn)
    }
}

/// Creates a table value with its unit, the origin `free` and a note.
fn number(value: f64, unit: &str, note: &str) -> toml::Value {
    let entries = [
        ("value", toml::Value::from(value)),
        ("unit", unit.into()),
        ("origin", "free".into()),
        ("note", note.into()),
    ];
    let entries = entries.map(|(key, value)| (key.to_owned(), value));
    toml::Value::Table(entries.into_iter().collect())
}
