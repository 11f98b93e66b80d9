//! Status word of a Net F/T record: its bits by name, and the validity of the reading.

use std::fmt;

/// Status word of a reading; 0 means no error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Status(pub(super) u32);

/// Status with a latched threshold and no other error: the threshold bit and the error bit. Readings remain valid.
const LATCHED: u32 = 0x8001_0000;
const SATURATED: u32 = 1 << 17;

/// Names of the status bits of a Net F/T box, from bit 0, after its manual.
const NAMES: [&str; 32] = [
    "reserved",
    "web server failed",
    "internal temperature wrong",
    "reference voltage or power monitor wrong",
    "no data from the transducer",
    "supply of the analog board too low",
    "supply of the analog board too high",
    "artificial analog ground out of range",
    "excitation current of a gauge too low",
    "excitation current of a gauge too high",
    "analog board did not respond",
    "serial flash memory failed",
    "serial EEPROM failed",
    "stack check failed",
    "watchdog expired",
    "reserved",
    "threshold latched",
    "strain gauge saturated",
    "DeviceNet failed",
    "EtherNet/IP failed",
    "readings over UDP failed",
    "CAN bus failed",
    "network failed",
    "configuration does not match the calibration",
    "settings invalid",
    "halted by an error in the configuration",
    "program memory changed",
    "serial link to the transducer failed",
    "analog board failed",
    "digital board failed",
    "processor or memory failed",
    "error",
];

impl Status {
    /// True if a strain gauge of the transducer is saturated, so that the force is clipped.
    pub(super) fn is_saturated(self) -> bool {
        self.0 & SATURATED != 0
    }

    /// True if only a threshold is latched, so that the reading is valid.
    pub(super) fn is_latched(self) -> bool {
        self.0 == LATCHED
    }

    /// True if the reading is invalid.
    pub(super) fn has_error(self) -> bool {
        self.0 != 0 && !self.is_latched()
    }
}

impl fmt::Display for Status {
    /// Status with the names of its bits: `status 0x80020000: strain gauge saturated (bit 17), error (bit 31)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "status {:#010x}", self.0)?;
        let bits = (0_u32..).zip(NAMES);
        let set = bits.filter(|&(bit, _)| (self.0 >> bit) & 1 == 1);
        for (position, (bit, name)) in set.enumerate() {
            let separator = if position == 0 { ": " } else { ", " };
            write!(f, "{separator}{name} (bit {bit})")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_all_words_only_zero_and_a_latched_threshold_give_readings() {
        assert!(!Status(0).has_error() && !Status(0).is_latched());
        assert!(!Status(LATCHED).has_error() && Status(LATCHED).is_latched());
        for bit in 0..32_u32 {
            assert!(Status(1 << bit).has_error(), "bit {bit} alone");
            let with_error = Status((1 << 31) | (1 << bit));
            assert_eq!(with_error.has_error(), bit != 16, "bit {bit}");
            assert!(Status(LATCHED | (1 << bit)).has_error() || [16, 31].contains(&bit));
        }
    }

    #[test]
    fn each_bit_has_its_name() {
        assert_eq!(Status(0).to_string(), "status 0x00000000");
        assert_eq!(
            Status(0x8002_0000).to_string(),
            "status 0x80020000: strain gauge saturated (bit 17), error (bit 31)"
        );
        for (bit, name) in NAMES.into_iter().enumerate() {
            let said = Status(1 << bit).to_string();
            assert!(said.ends_with(&format!(": {name} (bit {bit})")), "{said}");
        }
    }
}
