//! A module with its functions in another order. Nobody reads them in any, but compressors do: gzip remembers
//! 32 kB and finds what it had there. So those that are like each other stand side by side, which makes the
//! first part of the page smaller by a twentieth.

use std::cmp::Ordering;

use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{
    CodeSectionReader, CustomSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef,
};

/// The module with like functions side by side, and without names of functions and the like.
pub fn ordered(wasm: &[u8]) -> Result<Vec<u8>, String> {
    let says = |error: String| format!("A part of the module is no wasm: {error}.");
    let mut order = Order::of(wasm).map_err(|error| says(error.to_string()))?;
    let mut module = Module::new();
    order.parse_core_module(&mut module, Parser::new(0), wasm).map_err(|error| says(error.to_string()))?;
    Ok(module.finish())
}

/// Where functions go to.
struct Order {
    /// So many come from outside, and stay before all others.
    imported: usize,
    /// The others in their new order, by their place in the old one.
    order: Vec<usize>,
    /// The new place of each.
    places: Vec<usize>,
}

impl Order {
    fn of(wasm: &[u8]) -> Result<Self, wasmparser::BinaryReaderError> {
        let (mut imported, mut types, mut bodies) = (0, Vec::new(), Vec::new());
        for payload in Parser::new(0).parse_all(wasm) {
            match payload? {
                Payload::ImportSection(section) => {
                    for import in section.into_imports() {
                        imported += usize::from(matches!(import?.ty, TypeRef::Func(_)));
                    }
                }
                Payload::FunctionSection(section) => types = section.into_iter().collect::<Result<_, _>>()?,
                Payload::CodeSectionEntry(body) => bodies.push(body),
                _ => {}
            }
        }
        let mut order: Vec<usize> = (0..bodies.len()).collect();
        order.sort_by(|a, b| types[*a].cmp(&types[*b]).then_with(|| by_likeness(&bodies[*a], &bodies[*b])));
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, function)| places[*function] = place);
        Ok(Self { imported, order, places })
    }
}

/// Functions of the same type that come from the same source for other types are about as long, and begin in
/// the same way.
fn by_likeness(a: &FunctionBody, b: &FunctionBody) -> Ordering {
    /// Lengths that differ by less are the same. Found by trying.
    const STEP: usize = 32;
    let [a, b] = [a, b].map(FunctionBody::as_bytes);
    (a.len() / STEP).cmp(&(b.len() / STEP)).then_with(|| a.cmp(b))
}

impl Reencode for Order {
    type Error = std::convert::Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error> {
        let place = (function as usize).checked_sub(self.imported).and_then(|at| self.places.get(at));
        Ok(place.map_or(function, |place| (self.imported + place) as u32))
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader,
    ) -> Result<(), Error> {
        let types = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        for function in &self.order {
            functions.function(types[*function]);
        }
        Ok(())
    }

    fn parse_code_section(
        &mut self,
        code: &mut CodeSection,
        section: CodeSectionReader,
    ) -> Result<(), Error> {
        let bodies = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        let order = self.order.clone();
        order.into_iter().try_for_each(|function| self.parse_function_body(code, bodies[function].clone()))
    }

    fn parse_custom_section(&mut self, _: &mut Module, _: CustomSectionReader) -> Result<(), Error> {
        Ok(())
    }
}
