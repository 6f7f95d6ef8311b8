//! A module with its functions in another order. Nobody reads them in any, but compressors do: gzip remembers
//! 32 kB and finds what it had there. So those that are like each other stand near each other, which makes the
//! parts of the page smaller by a sixteenth.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::HashMap;

use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{
    CodeSectionReader, CustomSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef,
};

use crate::uniform::uniform;

/// The module with like functions side by side, where it is to be packed, and without names of functions and the
/// like.
pub fn ordered(wasm: &[u8], is_packed: bool) -> Result<Vec<u8>, String> {
    let says = |error: String| format!("A part of the module is no wasm: {error}.");
    // What is packed is what is to be like each other.
    let alike = || uniform(wasm).map(Cow::Owned).map_err(|error| says(error.to_string()));
    let wasm = &if is_packed { alike()? } else { Cow::Borrowed(wasm) };
    let mut order = Order::of(wasm, is_packed).map_err(|error| says(error.to_string()))?;
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
    fn of(wasm: &[u8], is_packed: bool) -> Result<Self, wasmparser::BinaryReaderError> {
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
        // This takes some seconds.
        let order = if is_packed { by_likeness(&types, &bodies) } else { (0..bodies.len()).collect() };
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, function)| places[*function] = place);
        Ok(Self { imported, order, places })
    }
}

/// One function after another, each time the one that has most in common with what was written last: as runs of
/// bytes that stand in both. The same source, compiled for other types, gives such functions.
fn by_likeness(types: &[u32], bodies: &[FunctionBody]) -> Vec<usize> {
    /// Found by trying, as are the others: shorter runs stand everywhere.
    const RUN: usize = 5;
    /// So many bytes were written last: a little less than gzip remembers.
    const NEAR: usize = 28 * 1024;
    /// How much the very last function counts beside them.
    const LAST: f64 = 2.0;
    const SAME_TYPE: f64 = 1.3;
    // The runs by numbers, those of each function, and the functions that have each.
    let mut numbers: HashMap<&[u8], usize> = HashMap::new();
    let mut holders: Vec<Vec<usize>> = Vec::new();
    let mut runs: Vec<Vec<usize>> = Vec::new();
    for (function, body) in bodies.iter().enumerate() {
        let mut own = Vec::new();
        for run in body.as_bytes().windows(RUN) {
            let next = numbers.len();
            let run = *numbers.entry(run).or_insert(next);
            if run == next {
                holders.push(Vec::new());
            }
            if holders[run].last() != Some(&function) {
                holders[run].push(function);
                own.push(run);
            }
        }
        runs.push(own);
    }
    for holders in holders.iter_mut().filter(|holders| holders.len() == 1) {
        holders.clear();
    }
    let mut left: Vec<usize> = (0..bodies.len()).collect();
    left.sort_by_key(|function| (types[*function], bodies[*function].as_bytes().len()));
    let mut order = Vec::with_capacity(bodies.len());
    // How often each run stands in what was written last, and how many of each function's runs do.
    let mut near = vec![0_usize; holders.len()];
    let mut shared = vec![0_usize; bodies.len()];
    let (mut size, mut behind) = (0, 0);
    let mut next = (!left.is_empty()).then_some(0);
    while let Some(at) = next {
        let last = left.remove(at);
        order.push(last);
        size += bodies[last].as_bytes().len();
        for run in &runs[last] {
            near[*run] += 1;
            if near[*run] == 1 {
                holders[*run].iter().for_each(|holder| shared[*holder] += 1);
            }
        }
        while size > NEAR && behind < order.len() {
            let gone: usize = order[behind];
            behind += 1;
            size -= bodies[gone].as_bytes().len();
            for run in &runs[gone] {
                near[*run] -= 1;
                if near[*run] == 0 {
                    holders[*run].iter().for_each(|holder| shared[*holder] -= 1);
                }
            }
        }
        let mut with_last = vec![0_usize; bodies.len()];
        for run in &runs[last] {
            holders[*run].iter().for_each(|holder| with_last[*holder] += 1);
        }
        let score = |function: usize| {
            let own = runs[function].len().max(1) as f64;
            let both = with_last[function] as f64;
            // The share of what stands in both in what stands in either.
            let likeness = both / (own + runs[last].len().max(1) as f64 - both);
            let same = if types[function] == types[last] { SAME_TYPE } else { 1.0 };
            shared[function] as f64 / own + LAST * same * likeness
        };
        // The first one of those that are as like.
        next = (0..left.len())
            .map(|at| (score(left[at]), Reverse(at)))
            .max_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))
            .map(|best| best.1.0);
    }
    order
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
