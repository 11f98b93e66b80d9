//! Name and digest of a list of faults.

use taceva_dataset::Digest;

use crate::fault::Fault;
use crate::faults::{LIST_VERSION, LISTS};
use crate::others::OtherFaults;
use crate::report::FaultList;
use crate::setup::StressRequest;

/// Name and digest of the tested faults and severities. `has_leds` is true if the sides of the LEDs of the sensor are known.
pub(crate) fn list(
    faults: &[&'static Fault],
    request: &StressRequest,
    others: OtherFaults<'_>,
    has_leds: bool,
) -> FaultList {
    let known = faults.iter().map(|fault| fault.id);
    let own: Vec<&str> = known.clone().collect();
    let worn = others.worn.iter().map(|fault| fault.id.as_str());
    let foreign = others.foreign.iter().map(|fault| fault.name());
    let ids = known.chain(worn).chain(foreign);
    let ids: Vec<&str> = ids.collect();
    let severities: Vec<String> = request.severities.iter().map(u8::to_string).collect();
    let is_alone = ids.len() == own.len() && request.severities.len() == 5;
    let mut whole = LISTS.iter().filter(|list| {
        let all = list.faults.iter().map(|fault| fault.id);
        is_alone && own.iter().copied().eq(all)
    });
    let mut text = format!(
        "{LIST_VERSION}\n{:?}\n{}\n{}\n",
        request.by,
        severities.join(","),
        ids.join(",")
    );
    if request.draws > 1 {
        text.push_str(&format!("{} draws\n", request.draws));
    }
    for fault in faults.iter().filter(|fault| has_leds && fault.is_of_leds()) {
        text.push_str(&format!("{} by colour\n", fault.id));
    }
    for fault in others.foreign {
        text.push_str(&format!("{} is {}\n", fault.name(), fault.key()));
    }
    FaultList {
        name: match whole.next() {
            Some(list) => format!("{}/{LIST_VERSION}", list.name),
            None => ids.join(","),
        },
        digest: Digest::of(text.as_bytes()).to_string(),
    }
}
