//! Decoder of pedal reports. No I/O.

/// Bits of a report that tell if the pedal is pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bits {
    /// Number of the report, expected as its first byte; `None` if the device does not number its reports.
    pub(super) report: Option<u8>,
    /// Index of the byte with the bits of the pedal, from 0, after the report number. `None` for all bytes.
    pub(super) byte: Option<usize>,
    /// Mask of the pedal's bits within a byte.
    pub(super) mask: u8,
}

impl Bits {
    /// True if one of the bits is set in the report: the pedal is pressed. `None` for another report number. A report that is too short counts as released.
    pub(super) fn held(self, report: &[u8]) -> Option<bool> {
        let body = match self.report {
            Some(number) => match report {
                [first, body @ ..] if *first == number => body,
                _ => return None,
            },
            None => report,
        };
        match self.byte {
            Some(byte) => Some(body.get(byte).is_some_and(|byte| byte & self.mask != 0)),
            None => Some(body.iter().any(|byte| byte & self.mask != 0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANY: Bits = Bits {
        report: None,
        byte: None,
        mask: 0xff,
    };

    #[test]
    fn a_pedal_that_types_a_letter_is_held_while_the_letter_is() {
        // The boot report of a keyboard: modifiers, nothing, six keys; 5 is `b`.
        assert_eq!(ANY.held(&[0, 0, 5, 0, 0, 0, 0, 0]), Some(true));
        assert_eq!(ANY.held(&[2, 0, 0, 0, 0, 0, 0, 0]), Some(true));
        assert_eq!(ANY.held(&[0; 8]), Some(false));
    }

    #[test]
    fn one_button_of_a_pad_whose_sticks_rest_in_the_middle_is_known_by_its_bit() {
        let pad = Bits {
            report: Some(1),
            byte: Some(2),
            mask: 0b0001_0000,
        };
        assert_eq!(pad.held(&[1, 0x80, 0x80, 0x10]), Some(true));
        assert_eq!(pad.held(&[1, 0x80, 0x80, 0x2f]), Some(false));
        assert_eq!(pad.held(&[2, 0x80, 0x80, 0x10]), None);
    }

    #[test]
    fn a_report_that_is_cut_off_holds_nothing() {
        let pad = Bits {
            byte: Some(2),
            ..ANY
        };
        for length in 0..3 {
            assert_eq!(
                pad.held(&[0xff; 3][..length]),
                Some(false),
                "{length} bytes"
            );
        }
        assert_eq!(
            Bits {
                report: Some(1),
                ..ANY
            }
            .held(&[]),
            None
        );
    }
}
