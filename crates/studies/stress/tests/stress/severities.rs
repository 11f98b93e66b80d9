//! Tests of severities that are set by stimulus or by parameter.

use taceva_stress::{
    By, FAULTS, RECORDING_FAULTS, StressRequest, TARGETS, TAXEL_FAULTS, TIME_FAULTS, severities,
    stress,
};

use crate::drawing::{WORK, unseen};

#[test]
fn a_higher_severity_changes_pictures_more() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let report = stress(&dataset, &model, &StressRequest::default(), WORK).expect("tested");
    assert_eq!(report.faults.len(), FAULTS.len());
    for fault in &report.faults {
        let tested = &fault.severities;
        assert!(!tested.is_empty(), "{}", fault.id);
        let all = tested.len() + fault.unreached.len();
        assert_eq!(all, 5, "{}", fault.id);
        for pair in tested.windows(2) {
            assert!(pair[0].parameter < pair[1].parameter, "{}", fault.id);
            let stimuli = [&pair[0], &pair[1]].map(|of| of.stimulus.expect("known"));
            assert!(stimuli[0] < stimuli[1], "{}: {stimuli:?}", fault.id);
        }
    }
}

#[test]
fn the_stimulus_of_a_darker_picture_is_the_target() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        faults: vec!["exposure_low".to_owned()],
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    for of in &report.faults[0].severities {
        let target = TARGETS[usize::from(of.severity) - 1];
        let stimulus = of.stimulus.expect("known");
        // Numbers of pixels are whole, so that a small change of all of them comes in steps.
        assert!(
            stimulus > 0.5 * target && stimulus < 2.5 * target + 0.05,
            "{of:?}"
        );
        assert_eq!(of.low_stimulus, stimulus < 0.05);
    }
}

#[test]
fn a_severity_has_the_same_parameter_beside_any_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let of_third = |severities: &[u8]| {
        let request = StressRequest {
            severities: severities.to_vec(),
            ..StressRequest::default()
        };
        let report = stress(&dataset, &model, &request, WORK).expect("tested");
        let third = report.faults.into_iter().map(|fault| {
            let mut reached = fault.severities.into_iter();
            let reached = reached.find(|of| of.severity == 3).map(|of| of.parameter);
            let mut unreached = fault.unreached.into_iter();
            (reached, unreached.find(|of| of.severity == 3))
        });
        third.collect::<Vec<_>>()
    };
    let alone = of_third(&[3]);
    assert!(alone.iter().any(|(reached, _)| reached.is_some()));
    assert_eq!(alone, of_third(&[1, 3]));
    assert_eq!(alone, of_third(&[1, 2, 3, 4, 5]));
}

#[test]
fn severities_by_parameter_are_those_of_the_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        by: By::Parameter,
        severities: vec![1, 4],
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    for (fault, of) in FAULTS.into_iter().zip(&report.faults) {
        let found: Vec<f64> = of.severities.iter().map(|of| of.parameter).collect();
        assert_eq!(found, [fault.table[0], fault.table[3]], "{}", fault.id);
        assert!(fault.table.is_sorted() && fault.table[4] <= fault.most);
    }
    assert!(report.list.name.starts_with("defocus,dead_pixels,"));
}

/// Table rows in `docs/faults.md` whose first cell is `name`. Each row is returned without this cell.
fn rows_of_page(name: &str) -> Vec<Vec<&'static str>> {
    let page: &'static str = include_str!("../../../../../docs/faults.md");
    let rows = page.lines().filter_map(|line| {
        let cells = line.strip_prefix('|')?.strip_suffix('|')?.split('|');
        Some(cells.map(str::trim).collect::<Vec<&'static str>>())
    });
    let own = rows.filter(|cells| cells[0] == name);
    own.map(|cells| cells[1..].to_vec()).collect()
}

/// Parses a number or a ratio of two numbers, such as `40/255`.
fn number(text: &str) -> Option<f64> {
    match text.split_once('/') {
        Some((part, whole)) => Some(part.parse::<f64>().ok()? / whole.parse::<f64>().ok()?),
        None => text.parse::<f64>().ok(),
    }
}

#[test]
fn each_table_of_the_page_names_each_fault_and_one_states_its_parameters() {
    let numbers = |name: &str| -> Vec<Vec<f64>> {
        let rows = rows_of_page(name);
        let numbers = rows.iter().filter_map(|cells| {
            let cells = cells.iter().map(|cell| number(cell));
            cells.collect::<Option<Vec<f64>>>()
        });
        numbers.collect()
    };
    for fault in FAULTS {
        let name = format!("`{}`", fault.id);
        assert_eq!(rows_of_page(&name).len(), 5, "{name}");
        assert_eq!(numbers(&name), [fault.table.to_vec()], "{name}");
    }
    let others = RECORDING_FAULTS.into_iter().chain(TAXEL_FAULTS);
    for fault in others.chain(TIME_FAULTS) {
        let rows = rows_of_page(&format!("`{}`", fault.id));
        let stated = rows.iter().map(|cells| {
            let numbers = cells.iter().filter_map(|cell| number(cell));
            numbers.collect::<Vec<f64>>()
        });
        let stated: Vec<Vec<f64>> = stated.collect();
        assert_eq!(stated, [fault.table.to_vec()], "{}", fault.id);
    }
    assert_eq!(numbers("stimulus"), [TARGETS.to_vec()]);
}

#[test]
fn severities_are_read_as_numbers_and_ranges() {
    let read = |text: &str| severities(text).expect(text);
    assert_eq!(read("1-5"), [1, 2, 3, 4, 5]);
    assert_eq!(read("5,1,3-4"), [1, 3, 4, 5]);
    for wrong in ["0", "6", "high", "", "4-2", "1-", "1-9"] {
        let refused = severities(wrong).expect_err(wrong).to_string();
        assert!(
            refused.contains("expected numbers from 1 to 5"),
            "{refused}"
        );
    }
}
