//! Tests of the settings that a page states, and of their contradictions to a selector.

use super::*;

const PLAIN: &str = "<netft><prodname>Net F/T</prodname><runrate>7000</runrate><setuserfilter>0</setuserfilter><setbias>0;0;0;0;0;0</setbias><cfgcalsn>FT12345</cfgcalsn><cfgmr>65;65;200;5;5;5</cfgmr><scfgtdu>mm</scfgtdu><scfgtau>degrees</scfgtau><cfgtfx>0;0;0;0;0;0</cfgtfx><comrdtrate>500</comrdtrate></netft>";

fn setup(page: &str) -> Setup {
    let page = Page::whole(page.to_owned()).expect("a whole page");
    Setup::read(&page, 1.0).expect("settings")
}

fn expected() -> Expected {
    Expected {
        frame: Frame::Own,
        rate_hz: None,
        force_max_n: None,
    }
}

#[test]
fn settings_of_a_plain_box_are_kept_without_a_warning() {
    let setup = setup(PLAIN);
    assert_eq!(setup.check(&expected()), Ok(()));
    assert_eq!(setup.warnings(), Vec::<String>::new());
    assert_eq!(setup.ranges_n(), Some([65.0, 65.0, 200.0]));
    let kept: Vec<String> = setup
        .settings()
        .into_iter()
        .map(|(key, value)| format!("{key}={value}"))
        .collect();
    assert_eq!(
        kept,
        [
            "bias=none",
            "box=Net F/T",
            "filter=0",
            "frame=own",
            "range_N=65",
            "rate_hz=500",
            "serial=FT12345"
        ]
    );
}

#[test]
fn a_turned_tool_frame_is_refused_unless_it_is_wanted_and_then_kept() {
    let turned = setup(&PLAIN.replace("<cfgtfx>0;0;0;0;0;0", "<cfgtfx>0;0;0;90;0;45"));
    let refused = turned.check(&expected()).expect_err("turned");
    for words in [
        "0;0;0;90;0;45 (mm, degrees)",
        "Configurations page",
        "`frame=tool`",
    ] {
        assert!(refused.contains(words), "{refused}");
    }
    let wanted = Expected {
        frame: Frame::Tool,
        ..expected()
    };
    assert_eq!(turned.check(&wanted), Ok(()));
    assert_eq!(turned.ranges_n(), Some([65.0; 3]));
    let frame = turned.settings().remove("frame");
    assert_eq!(frame.as_deref(), Some("tool 0;0;0;90;0;45 (mm, degrees)"));
    let moved = setup(&PLAIN.replace("<cfgtfx>0;", "<cfgtfx>12.5;"));
    assert!(moved.check(&expected()).is_err());
}

#[test]
fn a_rate_or_a_range_that_the_selector_states_otherwise_is_refused_with_the_line_to_write() {
    let setup = setup(PLAIN);
    let with_rate = |rate_hz| {
        setup.check(&Expected {
            rate_hz: Some(rate_hz),
            ..expected()
        })
    };
    assert_eq!(with_rate(500.0), Ok(()));
    let refused = with_rate(1000.0).expect_err("another rate");
    assert!(refused.contains("`rate=500`"), "{refused}");
    let with_range = |force_max_n| {
        setup.check(&Expected {
            force_max_n: Some(force_max_n),
            ..expected()
        })
    };
    assert_eq!(with_range(65.0), Ok(()));
    assert_eq!(with_range(20.0), Ok(()));
    let refused = with_range(650.0).expect_err("too wide");
    assert!(refused.contains("`force_max_n=65`"), "{refused}");
}

#[test]
fn a_box_that_rounds_its_rate_up_may_be_stated_by_either_rate() {
    let setup = setup(&PLAIN.replace("<comrdtrate>500", "<comrdtrate>2000"));
    for rate_hz in [2000.0, 2333.3] {
        let stated = Expected {
            rate_hz: Some(rate_hz),
            ..expected()
        };
        assert_eq!(setup.check(&stated), Ok(()), "{rate_hz}");
    }
}

#[test]
fn a_low_pass_is_kept_and_its_delay_is_a_warning() {
    for (filter, words) in [
        ("8", "about 31.8 ms"),
        ("4", "about 2.2 ms"),
        ("12", "about 0.1 ms"),
        ("13", "an unknown time"),
    ] {
        let page = PLAIN.replace("<setuserfilter>0", &format!("<setuserfilter>{filter}"));
        let setup = setup(&page);
        let warnings = setup.warnings();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        let is_named = warnings[0].contains(words) && warnings[0].contains("latency_ms");
        assert!(is_named, "{warnings:?}");
        assert_eq!(
            setup.settings().get("filter").map(String::as_str),
            Some(filter)
        );
    }
}

#[test]
fn an_entry_in_another_form_is_a_warning_and_a_tool_frame_in_one_is_refused() {
    let other = setup(
        &PLAIN
            .replace("<setuserfilter>0", "<setuserfilter>aus")
            .replace("65;65;200;5;5;5", "65;65;200"),
    );
    assert_eq!(other.check(&expected()), Ok(()));
    assert_eq!(other.ranges_n(), None);
    assert_eq!(other.settings().get("filter"), None);
    let warnings = other.warnings();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    for (warning, words) in warnings.iter().zip(["`cfgmr`", "is `aus`"]) {
        assert!(warning.contains(words), "{warning}");
    }
    let page = PLAIN.replace("<cfgtfx>0;0;0;0;0;0", "<cfgtfx>0;0;0;90 deg;0;45");
    let page = Page::whole(page).expect("a whole page");
    let error = Setup::read(&page, 1.0).expect_err("a frame").to_string();
    assert!(error.contains("`cfgtfx`"), "{error}");
}

#[test]
fn a_bias_is_kept_and_a_page_without_settings_is_a_warning() {
    let biased = setup(&PLAIN.replace("<setbias>0;0;0", "<setbias>0;-7;0"));
    assert_eq!(
        biased.settings().get("bias").map(String::as_str),
        Some("set")
    );
    let bare = setup("<netft></netft>");
    assert_eq!(bare.check(&expected()), Ok(()));
    assert_eq!(bare.settings().len(), 1, "{:?}", bare.settings());
    assert_eq!(
        bare.settings().get("frame").map(String::as_str),
        Some("unknown")
    );
    let warnings = bare.warnings();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    for (warning, key) in warnings.iter().zip(["`setuserfilter`", "`cfgtfx`"]) {
        assert!(warning.contains(&format!("has no {key}")), "{warning}");
    }
}
