//! Calibration of a Net F/T box: the force and the torque of one raw count.

use std::collections::BTreeMap;

use super::page::{Page, PageError, number};

/// Force and torque of one raw count of a Net F/T box, N and N·mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Calibration {
    pub(super) force_n: f64,
    pub(super) torque_nmm: f64,
    /// Force unit of the configuration page, in newtons: 4.448 for `lbf`.
    pub(super) force_unit_n: f64,
    /// Force unit of the configuration page.
    force_unit: Unit,
    torque_unit: Unit,
}

/// Name of a unit, and its size in N or N·mm.
type Unit = (&'static str, f64);

/// Force units that a Net F/T box can use, each with its size in N.
const FORCES: [Unit; 6] = [
    ("N", 1.0),
    ("kN", 1_000.0),
    ("lbf", 4.448_221_615_260_5),
    ("klbf", 4_448.221_615_260_5),
    ("kgf", 9.806_65),
    ("gf", 0.009_806_65),
];
/// Torque units that a Net F/T box can use, each with its size in N·mm.
const TORQUES: [Unit; 6] = [
    ("N-m", 1_000.0),
    ("N-mm", 1.0),
    ("kN-m", 1_000_000.0),
    ("lbf-in", 112.984_829_027_616_7),
    ("lbf-ft", 1_355.817_948_331_4),
    ("kgf-cm", 98.066_5),
];
/// Characters that may separate the two parts of a torque unit, such as `-` in `N-m`.
const BETWEEN: [char; 7] = ['-', '.', '·', '⋅', '•', '*', ' '];

impl Calibration {
    /// Reads the calibration from the configuration page of a box.
    pub(super) fn read(page: &Page) -> Result<Calibration, PageError> {
        let force_unit = unit(
            page,
            "scfgfu",
            &FORCES,
            "one of N, kN, lbf, klbf, kgf, gf: select it on the Configurations page of the box",
        )?;
        let torque_unit = unit(
            page,
            "scfgtu",
            &TORQUES,
            "one of N-m, N-mm, kN-m, lbf-in, lbf-ft, kgf-cm: select it on the Configurations page of the box",
        )?;
        let (_, force_unit_n) = force_unit;
        let (_, torque_unit_nmm) = torque_unit;
        Ok(Calibration {
            force_n: force_unit_n / counts(page, "cfgcpf")?,
            torque_nmm: torque_unit_nmm / counts(page, "cfgcpt")?,
            force_unit_n,
            force_unit,
            torque_unit,
        })
    }

    /// Settings of a recording: the force and torque units of the box, with the factor of each conversion by the driver.
    pub(super) fn settings(&self) -> BTreeMap<String, String> {
        let stated = |(name, worth): Unit, stored: &str| match name == stored.replace('·', "-") {
            true => name.to_owned(),
            false => format!("{name}, converted at {worth} {stored}"),
        };
        BTreeMap::from([
            ("unit".to_owned(), stated(self.force_unit, "N")),
            ("torque_unit".to_owned(), stated(self.torque_unit, "N·mm")),
        ])
    }
}

/// Counts per force or torque unit, from the entry `key` of the configuration page.
fn counts(page: &Page, key: &'static str) -> Result<f64, PageError> {
    let found = page.entry(key);
    let count = number(&found).filter(|count| count.is_normal() && *count > 0.0);
    count.ok_or_else(|| PageError::entry(key, "a number of counts above 0", &found))
}

/// Unit in the entry `key` of the configuration page. The comparison with `units` ignores case and one separator, as in `N-m`.
fn unit(
    page: &Page,
    key: &'static str,
    units: &[Unit],
    expected: &'static str,
) -> Result<Unit, PageError> {
    let found = page.entry(key);
    let name = found.replacen(BETWEEN, "", 1);
    let known = units
        .iter()
        .find(|(unit, _)| unit.replace('-', "").eq_ignore_ascii_case(&name));
    let known = known.copied();
    known.ok_or_else(|| PageError::entry(key, expected, &found))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOME: &str = "<netft><scfgfu>N</scfgfu><scfgtu> Nm </scfgtu><cfgcpf>1000000</cfgcpf><cfgcpt>1000000</cfgcpt></netft>";

    fn read(page: &str) -> Result<Calibration, PageError> {
        Calibration::read(&Page::whole(page.to_owned()).expect("a whole page"))
    }

    #[test]
    fn a_count_is_worth_what_the_page_says() {
        let calibration = read(SOME).expect("a page");
        assert!((calibration.force_n - 1e-6).abs() < 1e-18);
        assert!((calibration.torque_nmm - 1e-3).abs() < 1e-15);
        let pounds = SOME.replace(">N<", ">lbf<").replace("> Nm <", ">lbf-in<");
        let calibration = read(&pounds).expect("a page");
        assert!((calibration.force_n - 4.448_221_6e-6).abs() < 1e-12);
        assert!((calibration.torque_nmm - 112.984_829e-6).abs() < 1e-11);
    }

    #[test]
    fn units_of_a_box_and_their_conversion_are_kept_by_name() {
        let kept = |force: &str, torque: &str| {
            let page = SOME.replace(">N<", &format!(">{force}<"));
            let page = page.replace(" Nm ", torque);
            let settings = read(&page).expect("a page").settings();
            [settings["unit"].clone(), settings["torque_unit"].clone()]
        };
        assert_eq!(
            kept("N", "Nm"),
            ["N", "N-m, converted at 1000 N·mm"].map(str::to_owned)
        );
        for (force, torque, expected) in [
            ("gf", "N-mm", ["gf, converted at 0.00980665 N", "N-mm"]),
            (
                "LBF",
                "kgf-cm",
                [
                    "lbf, converted at 4.4482216152605 N",
                    "kgf-cm, converted at 98.0665 N·mm",
                ],
            ),
        ] {
            assert_eq!(kept(force, torque), expected.map(str::to_owned));
        }
    }

    #[test]
    fn units_are_read_as_boxes_and_clients_write_them() {
        for (units, expected_nmm) in [
            (
                &[
                    "Nm",
                    "N-m",
                    "N.m",
                    "N·m",
                    "N m",
                    "NM",
                    "n-m",
                    "N&#183;m",
                    "N&middot;m",
                ][..],
                1_000.0,
            ),
            (&["Nmm", "N-mm", "N·mm"], 1.0),
            (&["kNm", "kN-m", "KN-M"], 1_000_000.0),
            (&["lbf-ft", "LBF-FT", "lbfft"], 1_355.817_948_331_4),
            (&["kgf-cm"], 98.066_5),
        ] {
            for unit in units {
                let page = SOME.replace(" Nm ", unit);
                let calibration = read(&page).expect(unit);
                let torque_nmm = calibration.torque_nmm * 1e6;
                assert!((torque_nmm / expected_nmm - 1.0).abs() < 1e-12, "{unit}");
            }
        }
        let grams = read(&SOME.replace(">N<", ">gf<")).expect("grams");
        assert!((grams.force_n - 9.806_65e-9).abs() < 1e-18);
    }

    #[test]
    fn a_page_without_a_calibration_says_what_is_missing() {
        for (page, words) in [
            (SOME.replace("cfgcpf", "other"), "no `cfgcpf`"),
            (SOME.replace("<cfgcpf>1000000", "<cfgcpf>0"), "is `0`"),
            (
                SOME.replace("<cfgcpf>1000000", "<cfgcpf>1000000,0"),
                "is `1000000,0`",
            ),
            (SOME.replace("<cfgcpt>1000000", "<cfgcpt>NaN"), "is `NaN`"),
            (SOME.replace(">N<", ">stone<"), "is `stone`"),
            (SOME.replace(">N<", ">ньютон<"), "is `ньютон`"),
            (SOME.replace(">N<", ">mN<"), "is `mN`"),
            (SOME.replace(">N<", ">lb<"), "is `lb`"),
            (SOME.replace(" Nm ", "MN-m"), "is `MN-m`"),
            (SOME.replace(" Nm ", "N--m"), "is `N--m`"),
            (SOME.replace(" Nm ", "N/m"), "is `N/m`"),
            (SOME.replace("</scfgtu>", ""), "no `scfgtu`"),
        ] {
            let error = read(&page).expect_err(words).to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
