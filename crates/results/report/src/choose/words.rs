//! Vocabulary of needs.

use taceva_metrics::Better;

use super::property::Property;

/// Word of a need, with its synonyms, bounds and ranking properties.
pub(super) struct Word {
    /// Synonyms of the word.
    pub(super) names: &'static [&'static str],
    /// Bounds: property, true for a lower bound, number.
    pub(super) bounds: &'static [(Property, bool, f64)],
    /// Properties to rank by.
    pub(super) ranks: &'static [Property],
}

/// Words that are accepted without a number.
pub(super) const WORDS: &[Word] = &[
    Word {
        names: &["shear", "accurate shear", "shear force"],
        bounds: &[],
        ranks: &[Property::Error("Fxy")],
    },
    Word {
        names: &["no shear"],
        bounds: &[],
        ranks: &[
            Property::Error("Pxy"),
            Property::Error("Pz"),
            Property::Error("Fz"),
        ],
    },
    Word {
        names: &["normal force", "force", "accurate force"],
        bounds: &[],
        ranks: &[Property::Error("Fz")],
    },
    Word {
        names: &["depth", "accurate depth", "shallow contact", "shallow"],
        bounds: &[],
        ranks: &[
            Property::Error("Pz"),
            Property::Repeatability("Pz"),
            Property::Spatial("Pz"),
        ],
    },
    Word {
        names: &["deep contact", "deep"],
        bounds: &[(Property::GreatestDepth, true, 2.0)],
        ranks: &[Property::GreatestDepth],
    },
    Word {
        names: &["soft contact", "soft", "gentle"],
        bounds: &[],
        ranks: &[Property::Sensitivity],
    },
    Word {
        names: &["firm contact", "firm"],
        bounds: &[(Property::GreatestForce, true, 1.5)],
        ranks: &[],
    },
    Word {
        names: &[
            "planar",
            "accurate position",
            "localisation",
            "localization",
        ],
        bounds: &[],
        ranks: &[Property::Error("Pxy")],
    },
    Word {
        names: &["fast"],
        bounds: &[],
        ranks: &[Property::FrameRate],
    },
    Word {
        names: &["ambient light", "changing light", "light"],
        bounds: &[(Property::Opaque, true, 1.0)],
        ranks: &[],
    },
    Word {
        names: &["fine detail", "texture"],
        bounds: &[],
        ranks: &[Property::Resolution("line"), Property::Resolution("dot")],
    },
    Word {
        names: &["even surface"],
        bounds: &[],
        ranks: &[Property::Uniformity],
    },
    Word {
        names: &["large area"],
        bounds: &[],
        ranks: &[Property::FieldOfView],
    },
    Word {
        names: &["thin"],
        bounds: &[],
        ranks: &[Property::Thickness],
    },
    Word {
        names: &["thin gel"],
        bounds: &[],
        ranks: &[Property::GelThickness],
    },
    Word {
        names: &["can be bought", "bought", "buy"],
        bounds: &[(Property::Bought, true, 1.0)],
        ranks: &[],
    },
    Word {
        names: &["repeatable"],
        bounds: &[],
        ranks: &[Property::Repeatability("Pz"), Property::Repeatability("Fz")],
    },
    Word {
        names: &["rugged", "robust to faults"],
        bounds: &[],
        ranks: &[Property::Degradation("Fz"), Property::SkillEnd("Fz")],
    },
];

/// Quantity that a need can bound.
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) property: Property,
    /// True if the sensor must reach at least this number, even if the need says "up to". For instance, a press of up to 1 N requires a sensor that
    /// withstands 1 N.
    pub(super) is_reach: bool,
}

impl Quantity {
    /// True if a bare number is a lower bound.
    pub(super) fn is_least(&self) -> bool {
        self.is_reach || self.property.better() == Better::Higher
    }

    /// Need with `number`, as a user would write it: `rate >= 30 Hz`.
    pub(super) fn written(&self, number: &str) -> String {
        let sign = if self.is_least() { ">=" } else { "<=" };
        let need = format!("{} {sign} {number} {}", self.name, self.unit);
        need.trim_end().to_owned()
    }

    /// Accepted units, as text: ` and the unit Hz`; empty for a share.
    pub(super) fn units(&self) -> String {
        match (self.property, self.unit) {
            (Property::Price(_), _) => format!(" and a currency of {}", CURRENCIES.join(", ")),
            (_, "") => String::new(),
            (_, unit) => format!(" and the unit {unit}"),
        }
    }

    /// Need with a typical number, for messages.
    pub(super) fn example(&self) -> String {
        self.written(match self.unit {
            "Hz" => "30",
            "USD" => "500",
            "mm²" => "100",
            "" => "0.9",
            _ => "1",
        })
    }
}

const fn reach(name: &'static str, unit: &'static str, property: Property) -> Quantity {
    Quantity {
        name,
        unit,
        property,
        is_reach: true,
    }
}

const fn quality(name: &'static str, unit: &'static str, property: Property) -> Quantity {
    Quantity {
        is_reach: false,
        ..reach(name, unit, property)
    }
}

/// Currencies of prices.
pub(super) const CURRENCIES: [&str; 9] = [
    "USD", "EUR", "GBP", "AUD", "CAD", "CHF", "CNY", "JPY", "KRW",
];

/// Another unit of a quantity.
pub(super) struct OtherUnit {
    /// Symbol of the other unit, as the user writes it.
    pub(super) written: &'static str,
    /// Unit of the quantity.
    pub(super) unit: &'static str,
    /// Factor and divisor of the conversion. One of them is 1, so that decimal numbers remain exact.
    pub(super) times: f64,
    pub(super) over: f64,
}

const fn other_unit(written: &'static str, unit: &'static str, times: f64, over: f64) -> OtherUnit {
    OtherUnit {
        written,
        unit,
        times,
        over,
    }
}

/// Accepted units that differ from the unit of the quantity.
pub(super) const OTHER_UNITS: &[OtherUnit] = &[
    other_unit("mN", "N", 1.0, 1000.0),
    other_unit("um", "mm", 1.0, 1000.0),
    other_unit("µm", "mm", 1.0, 1000.0),
    other_unit("cm", "mm", 10.0, 1.0),
    other_unit("mm2", "mm²", 1.0, 1.0),
    other_unit("cm2", "mm²", 100.0, 1.0),
    other_unit("cm²", "mm²", 100.0, 1.0),
];

/// Quantities that can be bounded.
pub(super) const QUANTITIES: &[Quantity] = &[
    reach("force", "N", Property::GreatestForce),
    reach("depth", "mm", Property::GreatestDepth),
    quality("rate", "Hz", Property::FrameRate),
    quality("area", "mm²", Property::FieldOfView),
    quality("thickness", "mm", Property::Thickness),
    quality("sensor thickness", "mm", Property::Thickness),
    quality("height", "mm", Property::Thickness),
    quality("gel thickness", "mm", Property::GelThickness),
    quality("width", "mm", Property::Width),
    quality("size", "mm", Property::Size),
    quality("price", "USD", Property::Price("USD")),
    quality("localisation", "mm", Property::Error("Pxy")),
    quality("localization", "mm", Property::Error("Pxy")),
    quality("depth error", "mm", Property::Error("Pz")),
    quality("force error", "N", Property::Error("Fz")),
    quality("shear error", "N", Property::Error("Fxy")),
    quality("sensitivity", "mm/N", Property::Sensitivity),
    quality("uniformity", "", Property::Uniformity),
];
