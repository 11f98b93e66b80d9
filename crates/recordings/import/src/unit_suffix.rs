//! Unit in a column name: `Fz_mN`, `Fz (lbf)`, `Fz/mN`, `Fz, mN`, `pose_mm.x`.

use taceva_core::{SourceUnit, Unit};

/// Unit in the name of a column, in brackets or after a separator.
///
/// Lower-case spellings may be ambiguous: `torque_nm` means N·m, `depth_nm` means nanometres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnitSuffix {
    /// Unit text in the name.
    written: String,
    /// Name without the unit.
    pub(crate) base: String,
    units: Vec<SourceUnit>,
    is_bracketed: bool,
}

/// Lower-case spellings without separators, with their possible units.
const SPELLINGS: &[(&[&str], &[&str])] = &[
    (&["n", "newton", "newtons"], &["N"]),
    (&["mn", "millinewton", "millinewtons"], &["mN"]),
    (&["kn", "kilonewton", "kilonewtons"], &["kN"]),
    (&["nm"], &["Nm", "nm"]),
    (
        &["newtonmeter", "newtonmeters", "newtonmetre", "newtonmetres"],
        &["Nm"],
    ),
    (&["nmm", "newtonmillimeter", "newtonmillimetre"], &["Nmm"]),
    (&["mnm"], &["mNm"]),
    (&["g", "gr", "gram", "grams", "gf", "gramforce"], &["gf"]),
    (
        &["kg", "kgs", "kilogram", "kilograms", "kgf", "kilogramforce"],
        &["kgf"],
    ),
    (
        &["lb", "lbs", "lbf", "pound", "pounds", "poundforce"],
        &["lbf"],
    ),
    (&["klbf", "kip"], &["klbf"]),
    (&["oz", "ozf", "ounce", "ounces"], &["ozf"]),
    (&["dyn", "dyne", "dynes"], &["dyn"]),
    (&["lbfin", "lbin", "inlbf", "inlb", "inlbs"], &["lbf-in"]),
    (&["lbfft", "lbft", "ftlbf", "ftlb", "ftlbs"], &["lbf-ft"]),
    (&["ozfin", "ozin", "inozf"], &["ozf-in"]),
    (&["kgfcm", "kgcm"], &["kgf-cm"]),
    (&["gfcm", "gcm"], &["gf-cm"]),
    (
        &[
            "mm",
            "millimeter",
            "millimeters",
            "millimetre",
            "millimetres",
        ],
        &["mm"],
    ),
    (
        &[
            "cm",
            "centimeter",
            "centimeters",
            "centimetre",
            "centimetres",
        ],
        &["cm"],
    ),
    (&["m", "meter", "meters", "metre", "metres"], &["m"]),
    (
        &[
            "um",
            "µm",
            "μm",
            "micron",
            "microns",
            "micrometer",
            "micrometers",
            "micrometre",
            "micrometres",
        ],
        &["um"],
    ),
    (
        &["nanometer", "nanometers", "nanometre", "nanometres"],
        &["nm"],
    ),
    (&["inch", "inches"], &["inch"]),
    (&["s", "sec", "secs", "second", "seconds"], &["s"]),
    (
        &[
            "ms",
            "msec",
            "msecs",
            "millis",
            "millisec",
            "millisecond",
            "milliseconds",
        ],
        &["ms"],
    ),
    (
        &[
            "us",
            "µs",
            "μs",
            "usec",
            "usecs",
            "micros",
            "microsec",
            "microsecond",
            "microseconds",
        ],
        &["us"],
    ),
    (
        &[
            "ns",
            "nsec",
            "nsecs",
            "nanos",
            "nanosec",
            "nanosecond",
            "nanoseconds",
        ],
        &["ns"],
    ),
    (&["deg", "degs", "degree", "degrees", "°"], &["deg"]),
    (&["rad", "rads", "radian", "radians"], &["rad"]),
    (&["hz", "hertz"], &["Hz"]),
    (&["px", "pixel", "pixels"], &["px"]),
    (&["ut", "µt", "μt", "microtesla"], &["uT"]),
    (&["mt", "millitesla"], &["mT"]),
    (&["gauss"], &["G"]),
    (&["lsb", "count", "counts", "adc"], &["count"]),
    (&["v", "volt", "volts"], &["V"]),
    (&["mv", "millivolt", "millivolts"], &["mV"]),
    (&["pa", "pascal", "pascals"], &["Pa"]),
    (&["hpa"], &["hPa"]),
    (&["kpa", "kilopascal", "kilopascals"], &["kPa"]),
    (&["megapascal", "megapascals"], &["MPa"]),
    (&["psi"], &["psi"]),
    (&["bar", "bars"], &["bar"]),
    (&["mbar", "millibar", "millibars"], &["mbar"]),
    (&["degc", "°c", "celsius"], &["degC"]),
    (&["ohm", "ohms", "Ω"], &["ohm"]),
    (&["pf", "picofarad"], &["pF"]),
];

/// Words that may follow a one-letter unit: `force_N_raw`.
const QUALIFIERS: [&str; 18] = [
    "raw",
    "filtered",
    "filt",
    "smooth",
    "smoothed",
    "left",
    "right",
    "l",
    "r",
    "meas",
    "measured",
    "mean",
    "avg",
    "median",
    "tared",
    "compensated",
    "x",
    "z",
];

impl UnitSuffix {
    /// Finds the unit in `name`, or `None`. Names with several parts, such as `pose_mm.x` and `/Fz/mN`, are searched from the last part.
    pub(crate) fn of(name: &str) -> Option<UnitSuffix> {
        if let Some(found) = in_brackets(name) {
            return Some(found);
        }
        let parts: Vec<&str> = name.split(['.', '/', ':']).collect();
        (0..parts.len()).rev().find_map(|at| {
            let is_last = at + 1 == parts.len();
            // In `Fz/mN` the unit belongs to the part before it.
            let is_alone = is_last && parts[..at].iter().any(|part| !part.is_empty());
            let found = behind_separator(parts[at], is_alone)?;
            let mut others = parts.clone();
            others[at] = &found.base;
            let mut base = others.join(if name.contains('/') { "/" } else { "." });
            base.truncate(base.trim_end_matches(['.', '/', ':', ',', ' ']).len());
            Some(UnitSuffix { base, ..found })
        })
    }

    /// Unit text in the name.
    pub(crate) fn written(&self) -> &str {
        &self.written
    }

    /// Unit of `quantity` among the possible units in the name; `None` if no possible unit has this quantity.
    pub(crate) fn of_quantity(&self, quantity: Unit) -> Option<SourceUnit> {
        let mut units = self.units.iter();
        units.find(|unit| unit.unit() == quantity).copied()
    }

    /// Unit in the name; `None` if the unit is ambiguous.
    pub(crate) fn any_unit(&self) -> Option<SourceUnit> {
        match self.units.as_slice() {
            [only] => Some(*only),
            _ => None,
        }
    }

    /// True if the unit is counts or volts.
    pub(crate) fn is_unscaled(&self) -> bool {
        let is_raw = |unit: &SourceUnit| matches!(unit.unit(), Unit::Count | Unit::Volt);
        self.units.iter().all(is_raw)
    }

    /// Contradiction between the name and a map that states `unit`. `None` if both agree, or if the name states a different quantity, because an array `ft [N]`
    /// also contains torques.
    pub(crate) fn contradiction(&self, unit: &SourceUnit) -> Option<String> {
        let is_same = |own: &SourceUnit| {
            own.unit() == unit.unit() && own.convert(1.0).to_bits() == unit.convert(1.0).to_bits()
        };
        if self.units.iter().any(is_same) {
            return None;
        }
        let is_of_kind = |own: &&SourceUnit| own.unit() == unit.unit();
        let is_raw = self.is_unscaled()
            && matches!(
                unit.unit(),
                Unit::Newton | Unit::NewtonMillimetre | Unit::Millimetre | Unit::Kilopascal
            )
            && (self.is_bracketed || self.units.iter().all(|own| own.unit() == Unit::Count));
        let remedy = match (self.units.iter().find(is_of_kind), is_raw) {
            (None, false) => return None,
            (Some(own), _) => format!(
                "write `unit = \"{}\"`, or `scale = 1` beside the unit of the map if the name is wrong",
                own.symbol()
            ),
            (None, true) => format!(
                "set `scale` to the number of {} per unit of the column, or to 1 if the name is wrong",
                unit.symbol()
            ),
        };
        Some(format!(
            "the unit is `{}` by its name, but `{}` in the map: {remedy}",
            self.written,
            unit.symbol()
        ))
    }
}

/// Possible units of `text`; empty if `text` is not a unit.
fn units_of(text: &str) -> Vec<SourceUnit> {
    let text = text.trim();
    if text.is_empty()
        || text
            .bytes()
            .all(|byte| byte.is_ascii_digit() || byte == b'%')
    {
        return Vec::new();
    }
    let bare: String = text
        .chars()
        .filter(|letter| !matches!(letter, '·' | '*' | '-' | '.' | ' ' | '_' | '⋅'))
        .collect();
    // Exact case wins: `mN` differs from `MN`.
    for exact in [text, bare.as_str()] {
        let is_small = exact.chars().all(|letter| !letter.is_uppercase());
        if !is_small && let Ok(unit) = SourceUnit::parse(exact) {
            return vec![unit];
        }
    }
    if matches!(
        bare.as_str(),
        "MN" | "MPA" | "M" | "MM" | "S" | "MS" | "NS" | "US"
    ) {
        return match bare.as_str() {
            "MM" => SourceUnit::parse("mm").into_iter().collect(),
            _ => Vec::new(),
        };
    }
    let small = bare.to_lowercase();
    let found = SPELLINGS
        .iter()
        .find(|(known, _)| known.contains(&small.as_str()));
    let symbols = found.map_or(&[][..], |(_, symbols)| symbols);
    symbols
        .iter()
        .filter_map(|symbol| SourceUnit::parse(symbol).ok())
        .collect()
}

/// Unit in the last brackets of `name` that contain a unit.
fn in_brackets(name: &str) -> Option<UnitSuffix> {
    let mut end = name.len();
    while let Some(close) = name[..end].rfind([')', ']', '}', '>']) {
        let open = match name.as_bytes()[close] {
            b')' => '(',
            b']' => '[',
            b'}' => '{',
            _ => '<',
        };
        let begin = name[..close].rfind(open)?;
        let written = &name[begin + 1..close];
        let units = units_of(written);
        if !units.is_empty() && !name[..begin].trim().is_empty() {
            let base = format!("{} {}", name[..begin].trim(), name[close + 1..].trim());
            return Some(UnitSuffix {
                written: written.trim().to_owned(),
                base: base.trim().to_owned(),
                units,
                is_bracketed: true,
            });
        }
        end = begin;
    }
    None
}

/// Unit after `_`, `-`, a comma or a space. With `is_alone`, the whole part may be the unit.
fn behind_separator(part: &str, is_alone: bool) -> Option<UnitSuffix> {
    let separators = ['_', '-', ' ', ','];
    let mut tokens: Vec<(usize, &str)> = Vec::new();
    let mut begin = 0;
    for piece in part.split(separators) {
        if !piece.is_empty() {
            tokens.push((begin, piece));
        }
        begin += piece.len() + 1;
    }
    let first = usize::from(!is_alone || tokens.len() > 1);
    let found = |begin: usize, end: usize, units: Vec<SourceUnit>| {
        let base = format!(
            "{}{}",
            part[..begin].trim_end_matches(separators),
            &part[end..]
        );
        UnitSuffix {
            written: part[begin..end].to_owned(),
            base,
            units,
            is_bracketed: false,
        }
    };
    for at in (first..tokens.len()).rev() {
        let (begin, token) = tokens[at];
        let end = begin + token.len();
        // Units with a separator: `torque_N_m`, `Tz lbf-in`.
        if at > first {
            let (before, unit) = tokens[at - 1];
            let is_product = matches!(
                (
                    unit.to_ascii_lowercase().as_str(),
                    token.to_ascii_lowercase().as_str()
                ),
                ("n" | "mn", "m" | "mm")
                    | ("lbf" | "lb" | "ozf" | "oz", "in" | "ft")
                    | ("kgf" | "gf", "cm")
            ) && (unit.contains('N') || unit.contains('f') || unit.len() == 2);
            let units = units_of(&format!("{unit}{token}"));
            if is_product && !units.is_empty() {
                return Some(found(before, end, units));
            }
        }
        let units = units_of(token);
        if units.is_empty() {
            continue;
        }
        let behind = &tokens[at + 1..];
        let is_short = token.chars().count() == 1;
        let are_qualifiers = behind
            .iter()
            .all(|(_, word)| QUALIFIERS.contains(&word.to_ascii_lowercase().as_str()));
        if behind.is_empty() || (are_qualifiers && !is_short) || (are_qualifiers && token == "N") {
            return Some(found(begin, end, units));
        }
    }
    None
}

#[cfg(test)]
mod tests;
