//! Macro that implements `Display` by a method such as `name`.

/// Implements `Display` with the text of a method: `display!(Phase, name);`.
macro_rules! display {
    ($kind:ty, $text:ident) => {
        impl std::fmt::Display for $kind {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.$text())
            }
        }
    };
}

pub(crate) use display;
