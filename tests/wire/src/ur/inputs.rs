//! Inputs of a controller: the recipes of a client, and the registers that it writes.

use super::outputs::NOT_FOUND;

/// Number of registers of each type.
const COUNT: usize = 48;

/// Analog and digital outputs that clients set, with their types. The emulator ignores them.
const OUTPUTS: [(&str, &str); 10] = [
    ("standard_digital_output_mask", "UINT8"),
    ("standard_digital_output", "UINT8"),
    ("configurable_digital_output_mask", "UINT8"),
    ("configurable_digital_output", "UINT8"),
    ("tool_digital_output_mask", "UINT8"),
    ("tool_digital_output", "UINT8"),
    ("standard_analog_output_mask", "UINT8"),
    ("standard_analog_output_type", "UINT8"),
    ("standard_analog_output_0", "DOUBLE"),
    ("standard_analog_output_1", "DOUBLE"),
];

/// General-purpose registers that clients write, and the position of the speed slider that they request.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs {
    pub(super) integers: [i32; COUNT],
    pub(super) doubles: [f64; COUNT],
    /// 1 if a client requests to move the slider, otherwise 0.
    slider_mask: u32,
    slider_fraction: f64,
}

impl Default for Inputs {
    fn default() -> Inputs {
        Inputs {
            integers: [0; COUNT],
            doubles: [0.0; COUNT],
            slider_mask: 0,
            slider_fraction: 1.0,
        }
    }
}

impl Inputs {
    /// Requested position of the speed slider, 0 to 1, which is returned once; `None` without a new request.
    pub(super) fn take_slider(&mut self) -> Option<f64> {
        let is_asked = std::mem::take(&mut self.slider_mask) == 1;
        is_asked.then(|| self.slider_fraction.clamp(0.0, 1.0))
    }
}

/// Input of the controller that a recipe names.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Input {
    Integer(usize),
    Double(usize),
    /// Force of an external sensor, which the emulator ignores.
    Wrench,
    SliderMask,
    SliderFraction,
    /// Input of this type, which the emulator ignores.
    Ignored(&'static str),
}

/// Inputs in a message of a client, in their order.
#[derive(Debug)]
pub(super) struct Recipe(Vec<Input>);

impl Recipe {
    /// Parses a recipe: the names of inputs, separated by commas. Also returns the answer with their types. There is no recipe if an input is
    /// unknown.
    pub(super) fn read(names: &str) -> (Option<Recipe>, String) {
        // The recipes of a public client end with a comma.
        let names = names.strip_suffix(',').unwrap_or(names);
        let inputs: Vec<Option<Input>> = names.split(',').map(Input::of).collect();
        let types: Vec<&str> = inputs
            .iter()
            .map(|input| input.map_or(NOT_FOUND, Input::type_name))
            .collect();
        let recipe: Option<Vec<Input>> = inputs.iter().copied().collect();
        (recipe.map(Recipe), types.join(","))
    }

    /// Writes the values of a message to `inputs`. Returns false and changes nothing if their length differs from the recipe's.
    pub(super) fn write(&self, values: &[u8], inputs: &mut Inputs) -> bool {
        let length: usize = self.0.iter().map(|input| input.bytes()).sum();
        if values.len() != length {
            return false;
        }
        let mut rest = values;
        for input in &self.0 {
            let (value, after) = rest.split_at(input.bytes());
            match *input {
                Input::Integer(number) => {
                    inputs.integers[number] = value.try_into().map_or(0, i32::from_be_bytes);
                }
                Input::Double(number) => {
                    inputs.doubles[number] = value.try_into().map_or(0.0, f64::from_be_bytes);
                }
                Input::SliderMask => {
                    inputs.slider_mask = value.try_into().map_or(0, u32::from_be_bytes);
                }
                Input::SliderFraction => {
                    inputs.slider_fraction = value.try_into().map_or(1.0, f64::from_be_bytes);
                }
                Input::Wrench | Input::Ignored(_) => {}
            }
            rest = after;
        }
        true
    }
}

impl Input {
    fn of(name: &str) -> Option<Input> {
        match name {
            "external_force_torque" => return Some(Input::Wrench),
            "speed_slider_mask" => return Some(Input::SliderMask),
            "speed_slider_fraction" => return Some(Input::SliderFraction),
            _ => {}
        }
        if let Some(&(_, of)) = OUTPUTS.iter().find(|(output, _)| *output == name) {
            return Some(Input::Ignored(of));
        }
        let number = |begin: &str| {
            let number: usize = name.strip_prefix(begin)?.parse().ok()?;
            (number < COUNT).then_some(number)
        };
        number("input_int_register_")
            .map(Input::Integer)
            .or_else(|| number("input_double_register_").map(Input::Double))
    }

    fn type_name(self) -> &'static str {
        match self {
            Input::Integer(_) => "INT32",
            Input::Double(_) | Input::SliderFraction => "DOUBLE",
            Input::Wrench => "VECTOR6D",
            Input::SliderMask => "UINT32",
            Input::Ignored(of) => of,
        }
    }

    fn bytes(self) -> usize {
        match self {
            Input::Ignored("UINT8") => 1,
            Input::Integer(_) | Input::SliderMask => 4,
            Input::Double(_) | Input::SliderFraction | Input::Ignored(_) => 8,
            Input::Wrench => 48,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_to_the_registers_of_their_recipe_and_a_message_of_another_length_to_none() {
        let (recipe, types) = Recipe::read("input_int_register_1,input_double_register_7,");
        assert_eq!(types, "INT32,DOUBLE");
        let recipe = recipe.expect("both are known");
        let mut inputs = Inputs::default();
        let values = [&3_i32.to_be_bytes()[..], &0.25_f64.to_be_bytes()].concat();
        assert!(!recipe.write(&values[..11], &mut inputs));
        assert_eq!(inputs.integers[1], 0);
        assert!(recipe.write(&values, &mut inputs));
        assert_eq!(inputs.integers[1], 3);
        assert_eq!(inputs.doubles[7].to_bits(), 0.25_f64.to_bits());
    }

    #[test]
    fn a_slider_is_moved_once_where_its_mask_says_so_and_outputs_change_nothing() {
        let mut inputs = Inputs::default();
        // As `ur-rtde` 1.6.5 writes them.
        let names = "input_int_register_23,speed_slider_mask,speed_slider_fraction,";
        let (recipe, types) = Recipe::read(names);
        assert_eq!(types, "INT32,UINT32,DOUBLE");
        let values = b"\x00\x00\x00\x16\x00\x00\x00\x01\x3f\xe0\x00\x00\x00\x00\x00\x00";
        assert!(recipe.expect("all are known").write(values, &mut inputs));
        assert_eq!(inputs.take_slider(), Some(0.5));
        assert_eq!(inputs.take_slider(), None);
        let names = "input_int_register_23,standard_digital_output_mask,standard_digital_output,";
        let (recipe, types) = Recipe::read(names);
        assert_eq!(types, "INT32,UINT8,UINT8");
        let values = b"\x00\x00\x00\x0d\x02\x02";
        assert!(recipe.expect("all are known").write(values, &mut inputs));
        assert_eq!((inputs.integers[23], inputs.take_slider()), (13, None));
    }

    #[test]
    fn a_recipe_with_an_input_that_no_controller_has_is_none() {
        let (recipe, types) = Recipe::read("input_int_register_0,input_int_register_48");
        assert!(recipe.is_none());
        assert_eq!(types, "INT32,NOT_FOUND");
    }
}
