//! Tests that a stress test stops at the first severity at which no channel has skill.

use taceva_stress::{By, SeverityReport, StressRequest, stress};

use crate::drawing::{PRESSES, WORK, unseen};

fn request(stops_at_no_skill: bool) -> StressRequest {
    StressRequest {
        faults: vec!["exposure_low".to_owned(), "dust".to_owned()],
        by: By::Parameter,
        stops_at_no_skill,
        ..StressRequest::default()
    }
}

#[test]
fn a_fault_stops_at_the_severity_where_every_channel_has_lost_its_skill() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let whole = stress(&dataset, &model, &request(false), WORK).expect("tested");
    let stopped = stress(&dataset, &model, &request(true), WORK).expect("tested");
    for (whole, stopped) in whole.faults.iter().zip(&stopped.faults) {
        assert_eq!(whole.stopped_at, None);
        let has_skill = |of: &SeverityReport| {
            let mut scores = of.stale.values();
            scores.any(|score| score.skill.is_above_zero() != Some(false))
        };
        let end = whole.severities.iter().find(|of| !has_skill(of));
        let last = end.map_or(5, |of| of.severity);
        let tested: Vec<u8> = stopped.severities.iter().map(|of| of.severity).collect();
        assert_eq!(tested.last(), Some(&last), "{}", whole.id);
        assert_eq!(stopped.stopped_at, (last < 5).then_some(last));
        // The severities that both have are the same.
        let text = |of: &[SeverityReport]| serde_json::to_string(of).expect("JSON");
        assert_eq!(
            text(&whole.severities[..tested.len()]),
            text(&stopped.severities)
        );
    }
    let again = stopped.provenance.frames_decoded - whole.provenance.frames_decoded;
    assert_eq!(again % u64::from(PRESSES), 0);
}
