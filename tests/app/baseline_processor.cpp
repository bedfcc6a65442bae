// This file is linked into gridshell_baseline. It defines the symbols by which libgcc reports the
// features of the processor, with those of plain x86-64, so that the plain version of every
// function with clones (engine/core/block3.h) runs.
extern "C" {

struct ProcessorModel {
  unsigned vendor, type, subtype, features[1];
};
ProcessorModel __cpu_model{1, 0, 0, {0}};
unsigned __cpu_features2[8]{};

int __cpu_indicator_init() { return 0; }
}
