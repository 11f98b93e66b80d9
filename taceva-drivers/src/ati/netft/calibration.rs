//! Calibration of a box, read from its configuration page.

use std::io::{Read, Write};
use std::net::SocketAddr;
use std::time::Duration;

use taceva_core::ErrorKind;
use thiserror::Error;

use crate::link::{LinkError, connect};
use crate::text::shown;

/// Force per count, N, and torque per count, N·mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Calibration {
    pub(super) force_n: f64,
    pub(super) torque_nmm: f64,
}

/// Failure to read the calibration.
#[derive(Debug, Error)]
pub(super) enum CalibrationError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("{address} does not return {PAGE}: {source}")]
    Page {
        address: SocketAddr,
        source: std::io::Error,
    },
    #[error("{}, expected {expected}", stated(.key, .found))]
    Entry {
        key: &'static str,
        expected: &'static str,
        found: String,
    },
}

impl CalibrationError {
    /// Kind of the failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            CalibrationError::Link(error) => error.kind(),
            CalibrationError::Page { .. } | CalibrationError::Entry { .. } => ErrorKind::Protocol,
        }
    }
}

const PAGE: &str = "/netftapi2.xml";
/// Maximum length of the page, bytes.
const PAGE_MAX: u64 = 256 << 10;
const PATIENCE: Duration = Duration::from_secs(3);

/// Force units of the box, each with its value in N.
const FORCES: [(&str, f64); 5] = [
    ("N", 1.0),
    ("kN", 1_000.0),
    ("lbf", 4.448_221_615_260_5),
    ("klbf", 4_448.221_615_260_5),
    ("kgf", 9.806_65),
];
/// Torque units of the box, each with its value in N·mm.
const TORQUES: [(&str, f64); 6] = [
    ("Nm", 1_000.0),
    ("Nmm", 1.0),
    ("kNm", 1_000_000.0),
    ("lbf-in", 112.984_829_027_616_7),
    ("lbf-ft", 1_355.817_948_331_4),
    ("kgf-cm", 98.066_5),
];

impl Calibration {
    /// Reads the calibration from the page of the box at `host`.
    pub(super) fn ask(host: &str, port: u16) -> Result<Calibration, CalibrationError> {
        let (mut stream, address) = connect(host, port)?;
        let failed = |source| CalibrationError::Page { address, source };
        stream.set_read_timeout(Some(PATIENCE)).map_err(failed)?;
        let request = format!("GET {PAGE} HTTP/1.0\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        stream.write_all(request.as_bytes()).map_err(failed)?;
        let mut page = Vec::new();
        stream
            .take(PAGE_MAX)
            .read_to_end(&mut page)
            .map_err(failed)?;
        let page = String::from_utf8_lossy(&page);
        let status = page.lines().next().unwrap_or_default();
        if status.split(' ').nth(1) != Some("200") {
            let said = std::io::Error::other(format!("it answers `{}`", shown(status)));
            return Err(failed(said));
        }
        Calibration::read(&page)
    }

    /// Parses the page.
    fn read(page: &str) -> Result<Calibration, CalibrationError> {
        let force = per_count(
            page,
            ["cfgcpf", "scfgfu"],
            &FORCES,
            "one of N, kN, lbf, klbf, kgf",
        )?;
        let torque = per_count(
            page,
            ["cfgcpt", "scfgtu"],
            &TORQUES,
            "one of Nm, Nmm, kNm, lbf-in, lbf-ft, kgf-cm",
        )?;
        Ok(Calibration {
            force_n: force,
            torque_nmm: torque,
        })
    }
}

/// Value of a count: the value of the page's unit divided by its counts per unit.
fn per_count(
    page: &str,
    [counts, unit]: [&'static str; 2],
    units: &[(&str, f64)],
    expected_units: &'static str,
) -> Result<f64, CalibrationError> {
    let wrong = |key, expected, found: &str| CalibrationError::Entry {
        key,
        expected,
        found: found.chars().take(40).collect(),
    };
    let text = entry(page, counts);
    let count = text
        .parse()
        .ok()
        .filter(|count: &f64| count.is_normal() && *count > 0.0);
    let count = count.ok_or_else(|| wrong(counts, "a number of counts above 0", text))?;
    let name = entry(page, unit);
    let found = units.iter().find(|(known, _)| *known == name);
    let (_, worth) = found.ok_or_else(|| wrong(unit, expected_units, name))?;
    Ok(worth / count)
}

/// Trimmed content of the first element `key`; empty if there is none.
fn entry<'a>(page: &'a str, key: &str) -> &'a str {
    let between = page
        .split_once(&format!("<{key}>"))
        .and_then(|(_, behind)| behind.split_once(&format!("</{key}>")));
    between.map_or("", |(value, _)| value.trim())
}

/// Entry of the page as errors name it; `found` is empty if the page lacks it.
fn stated(key: &str, found: &str) -> String {
    match found {
        "" => format!("{PAGE} has no `{key}`"),
        found => format!("`{key}` in {PAGE} is `{}`", shown(found)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOME: &str = "HTTP/1.0 200 OK\r\n\r\n<netft><scfgfu>N</scfgfu><scfgtu> Nm </scfgtu><cfgcpf>1000000</cfgcpf><cfgcpt>1000000</cfgcpt></netft>";

    #[test]
    fn a_count_is_worth_what_the_page_says() {
        let calibration = Calibration::read(SOME).expect("a page");
        assert!((calibration.force_n - 1e-6).abs() < 1e-18);
        assert!((calibration.torque_nmm - 1e-3).abs() < 1e-15);
        let pounds = SOME.replace(">N<", ">lbf<").replace("> Nm <", ">lbf-in<");
        let calibration = Calibration::read(&pounds).expect("a page");
        assert!((calibration.force_n - 4.448_221_6e-6).abs() < 1e-12);
        assert!((calibration.torque_nmm - 112.984_829e-6).abs() < 1e-11);
    }

    #[test]
    fn a_page_without_a_calibration_says_what_is_missing() {
        for (page, words) in [
            (String::new(), "no `cfgcpf`"),
            (SOME.replace("<cfgcpf>1000000", "<cfgcpf>0"), "is `0`"),
            (SOME.replace("<cfgcpt>1000000", "<cfgcpt>NaN"), "is `NaN`"),
            (SOME.replace(">N<", ">stone<"), "is `stone`"),
            (SOME.replace("</scfgtu>", ""), "no `scfgtu`"),
        ] {
            let error = Calibration::read(&page).expect_err(words).to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
