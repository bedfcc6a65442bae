// Linked into gridshell_baseline: a processor that has nothing but plain x86-64, so that of every
// function with clones (engine/core/block3.h) the plain one runs. The compiler's own look at the
// processor (libgcc's cpuinfo) has these names.
extern "C" {

struct ProcessorModel {
  unsigned vendor, type, subtype, features[1];
};
ProcessorModel __cpu_model{1, 0, 0, {0}};
unsigned __cpu_features2[8]{};

int __cpu_indicator_init() { return 0; }
}
