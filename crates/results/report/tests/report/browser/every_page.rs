//! Tests of every kind of page: a data sheet fits one sheet of paper, and all are accessible.

use taceva_needs::skip;
use taceva_report::{
    Acceptance, CompareRequest, LimitsFile, Need, Study, accept, catalogue, choose, compare,
};

use super::{axe, open_page, page_of, print, two};
use crate::support::{self, drawn};

/// Data sheet with one limit for each metric in `limits_of` and each of the six channels.
fn sheet(limits_of: &[&str]) -> String {
    let mut text = "limits_version = 1\nname = \"line 3\"\n".to_owned();
    for metric in limits_of {
        for channel in support::SIX {
            let unit = match (*metric, channel.starts_with('P')) {
                ("r2" | "r_light", _) => "1",
                (_, true) => "mm",
                (_, false) => "N",
            };
            text += &format!(
                "[[limit]]\nmetric = \"{metric}\"\nchannel = \"{channel}\"\nunit = \"{unit}\"\nmost = 0.05\n"
            );
        }
    }
    let limits = LimitsFile::read(&text).expect("limits");
    let study = drawn("one", 60, 1.0);
    let findings = accept(&study, &limits).expect("checks");
    assert!(findings.iter().any(|finding| !finding.is_kept));
    let acceptance = Acceptance {
        limits: &limits,
        study: &study,
        findings: &findings,
        date: Some("2026-11-22"),
        pictures: None,
    };
    acceptance.page()
}

#[test]
fn a_data_sheet_is_one_page_of_paper() {
    for metrics in [&["mae"][..], &["mae", "r2", "r_spatial", "repeatability"]] {
        let Some(mut opened) = open_page(&sheet(metrics)) else {
            return;
        };
        assert_eq!(print::pages(&mut opened.browser), 1, "{metrics:?}");
        opened.browser.assert_quiet(super::is_report);
    }
}

#[test]
fn no_page_keeps_anybody_out() {
    let axe = match axe::source() {
        Ok(axe) => axe,
        Err(why) => return skip(taceva_needs::Need::Axe, why),
    };
    let studies = two();
    let needs = Need::parse("accurate shear, ambient light").expect("needs");
    let site = taceva_report::site(&catalogue::all(), &studies);
    let measured = two().map(|study| Study {
        source: "recorded".to_owned(),
        ..study
    });
    let mut pages = vec![
        ("report", page_of(&studies)),
        ("report of measured sensors", page_of(&measured)),
        (
            "comparison",
            compare(&studies, &CompareRequest::default()).page(&studies),
        ),
        (
            "choice",
            choose(&catalogue::all(), &needs).page("accurate shear, ambient light"),
        ),
        ("data sheet", sheet(&["mae"])),
    ];
    for file in ["index.html", "vitactip.html", "digit.html"] {
        let page = site.iter().find(|page| page.file == file).expect("there");
        pages.push((file, page.text.clone()));
    }
    let Some(mut opened) = open_page(&pages[0].1) else {
        return;
    };
    for (name, page) in &pages {
        opened.show(page);
        axe::assert_accessible(&mut opened.browser, &axe, name);
    }
}
